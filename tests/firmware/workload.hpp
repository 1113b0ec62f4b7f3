// The queries that cost is measured with, on every core and, for the answers, on the machine that tests: the same
// random numbers, the same questions, the same bits. Plainer than tests/platform/questions.hpp, which is awkward on
// purpose: these are what a program asks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include <espalier/espalier.hpp>

#include "../platform/fingerprint.hpp"
#include "measured_kinds.hpp"
#include "question_maker.hpp"

namespace espalier::firmware {

struct Counts {
    std::uint32_t usual = 200;  ///< of each of the five usual queries
    std::uint32_t other = 10;   ///< of the others
    std::uint32_t pairs = 1;    ///< of each query of two blobs
    std::uint32_t steps = 64;   ///< of a moving scene, every eighth with a repack
    std::uint32_t poses = 32;   ///< of a cloth
};

/// Asks the blob; `measure(kind, call)` runs each call. Every bit that comes back goes into the fingerprint.
template <class Measure>
class Workload : QuestionMaker {
public:
    Workload(std::span<const std::byte> bytes, const Blob& blob, const Measure& measure)
        : QuestionMaker(blob.bounds()), bytes_(bytes), blob_(blob), measure_(measure), lattice_(blob.lattice()) {}

    /// Opening and the five usual queries.
    void ask_usual(const Counts& counts) {
        open_again();
        for (std::uint32_t i = 0; i < counts.usual; ++i) ask_usual();
    }
    void ask_others(const Counts& counts) {
        for (std::uint32_t i = 0; i < counts.other; ++i) {
            ask_rays();
            ask_volumes();
            ask_points();
            ask_contacts();
            ask_sweeps();
            ask_coarsely();
        }
        for (std::uint32_t i = 0; i < counts.pairs; ++i) ask_pairs();
    }
    [[nodiscard]] const platform::Fingerprint& answers() const { return answers_; }

private:
    /// Measures a call and returns its result. The call builds it in place, as in a program that keeps it: no copy is
    /// measured.
    template <class Call>
    auto measured(Kind kind, const Call& call) {
        using Answer = decltype(call());
        alignas(Answer) std::byte place[sizeof(Answer)];
        measure_(kind, [&] { ::new (static_cast<void*>(place)) Answer(call()); });
        return *std::launder(reinterpret_cast<const Answer*>(place));
    }

    void add(const RayHit& hit) { answers_.add(hit.t, hit.u, hit.v, hit.normal, hit.triangle.index); }
    void add(const ClosestPoint& nearest) { answers_.add(nearest.point, nearest.distance, nearest.triangle.index); }
    void add_pair(const ClosestPoint& pair) {
        add(pair.status);
        answers_.add(pair.on_shape, pair.point, pair.triangle.index);
    }
    void add(const SweepHit& hit) { answers_.add(bool(hit), hit.t, hit.point, hit.triangle.index); }
    void add(const Vec3& point) { answers_.add(point.x, point.y, point.z); }
    void add(QueryStatus status) { answers_.add(static_cast<std::uint32_t>(status)); }

    template <class... Shape>
    void add_overlap(Kind kind, const Shape&... shape) {
        bool answer = false;
        measure_(kind, [&] { answer = overlaps(blob_, shape...).yes(); });
        answers_.add(answer);
    }

    void open_again() {
        // As a static Blob is initialised: the result is built where it stays.
        alignas(Blob) std::byte place[sizeof(Blob)];
        const auto status = [&] { return static_cast<std::uint32_t>(reinterpret_cast<const Blob*>(place)->status()); };
        measure_("open", [&] { new (place) Blob(open(bytes_)); });
        answers_.add(status());
        measure_("open_unchecked", [&] { new (place) Blob(open_unchecked(bytes_)); });
        answers_.add(status());
    }

    void ask_usual() {
        const Ray ray = this->ray();
        const Sphere sphere = this->sphere();
        const Box box = this->box();
        const Vec3 point = point_in_box();
        const RayHit hit = measured("raycast", [&] { return raycast(blob_, ray); });
        answers_.add(bool(hit));
        add(hit);
        answers_.add(measured("occluded", [&] { return occluded(blob_, ray); }).yes());
        add_overlap("overlaps_sphere", sphere);
        const ClosestPoint nearest = measured("closest_point", [&] { return closest_point(blob_, point); });
        answers_.add(bool(nearest));
        add(nearest);
        add_overlap("overlaps_box", box);
        ask_in_steps(box, ray);
    }

    /// The same box and ray, the latter to twice as far as its target.
    void ask_in_steps(const Box& world_box, const Ray& ray) {
        const Result<LatticeBox> around = to_lattice(lattice_, world_box);
        add(around.status);
        const LatticeBox& box = *around;
        const Vec3 end = {ray.origin.x + 2.0f * ray.direction.x, ray.origin.y + 2.0f * ray.direction.y,
                          ray.origin.z + 2.0f * ray.direction.z};
        const Result<LatticePoint> from = to_lattice(lattice_, ray.origin), to = to_lattice(lattice_, end);
        add(from.status);
        add(to.status);
        const LatticeSegment segment = {*from, *to};
        add_overlap("overlaps_box_in_steps", box);
        const LatticeHit hit = measured("first_hit_in_steps", [&] { return raycast(blob_, segment); });
        add(hit.status);
        answers_.add(hit.t, hit.triangle.index);
        add(measured("any_hit_in_steps", [&] { return occluded(blob_, segment); }).status());
    }

    void ask_rays() {
        const Ray ray = this->ray();
        std::uint32_t number = 0;
        add(measured("for_each_hit", [&] { return for_each_hit(blob_, ray, [&](const RayHit&) { ++number; }); }));
        add(measured("for_each_crossing",
                     [&] { return for_each_crossing(blob_, ray, [&](const RayHit&) { ++number; }); }));
        answers_.add(number);
        RayHit hits[4];
        const Filled few = measured("closest_hits", [&] { return closest_hits(blob_, ray, hits); });
        for (const RayHit& hit : few.in(hits)) add(hit);
        const Ray rays[4] = {ray, this->ray(), this->ray(), this->ray()};
        add(measured("raycast_batch", [&] { return raycast(blob_, rays, hits); }).status);
        for (const RayHit& hit : hits) add(hit);
    }

    void ask_volumes() {
        const Sphere sphere = this->sphere();
        const Box box = this->box();
        const Capsule capsule = {sphere.center, point_in_box(), sphere.radius};
        const Triangle corners = {sphere.center, box.min, box.max};
        const OrientedBox oriented = {box.min, {step(), step(), step()}};
        const Vec3 on = point_in_box();
        Plane planes[4];
        for (Plane& plane : planes) {
            const Vec3 normal = unit_vector();
            plane = {normal, normal.x * on.x + normal.y * on.y + normal.z * on.z + 0.02f * extent()};
        }
        std::uint32_t number = 0;
        const auto count = [&](TriangleId) { return ++number, Visit::next; };
        measure_("for_each_overlap_sphere", [&] { (void)for_each_overlap(blob_, sphere, count); });
        measure_("for_each_overlap_box", [&] { (void)for_each_overlap(blob_, box, count); });
        answers_.add(number);
        add_overlap("overlaps_capsule", capsule);
        add_overlap("overlaps_oriented_box", oriented);
        add_overlap("overlaps_triangle", corners);
        add_overlap("overlaps_planes", ConvexVolume{planes});
        const Cone cone = {sphere.center, oriented.half_axes[0], sphere.radius};
        add_overlap("overlaps_cone", cone);
    }

    void ask_points() {
        const Vec3 point = point_in_box();
        const Box box = this->box();
        const Vec3 end = point_in_box();
        ClosestPoint few[4];
        const Filled found = measured("closest_triangles", [&] { return closest_triangles(blob_, point, few); });
        for (const ClosestPoint& each : found.in(few)) add(each);
        YesNo answer;
        measure_("contains", [&] { answer = contains(blob_, point); });
        add(answer.status());
        answers_.add(answer.yes());
        const ClosestPoint nearest = measured("signed_distance", [&] { return signed_distance(blob_, point); });
        add(nearest.status);
        add(nearest);
        const Result<float> number = measured("winding_number", [&] { return winding_number(blob_, point, 16); });
        add(number.status);
        answers_.add(*number);
        add_pair(measured("closest_to_segment", [&] { return closest_point(blob_, Segment{point, end}); }));
        add_pair(measured("closest_to_box", [&] { return closest_point(blob_, box); }));
    }

    void ask_contacts() {
        const Sphere sphere = this->sphere();
        const float margin = 0.1f * sphere.radius, half = 0.5f * sphere.radius;
        const Vec3 &at = sphere.center, by = step();
        Contact contacts[8];
        const auto add_contacts = [&](const Filled& found) {
            add(found.status);
            for (const Contact& contact : found.in(contacts)) {
                answers_.add(contact.triangle.index, contact.distance);
                add(contact.point);
                add(contact.normal);
            }
        };
        add_contacts(measured("contacts_sphere", [&] { return find_contacts(blob_, sphere, margin, contacts); }));
        const Capsule capsule = {at, {at.x + by.x, at.y + by.y, at.z + by.z}, half};
        add_contacts(measured("contacts_capsule", [&] { return find_contacts(blob_, capsule, margin, contacts); }));
        const OrientedBox box = turned_box(at, half);
        add_contacts(measured("contacts_oriented_box", [&] { return find_contacts(blob_, box, margin, contacts); }));
        const Octahedron octahedron(at, half);
        add_contacts(measured("contacts_convex_hull",
                              [&] { return find_contacts(blob_, octahedron.hull(), margin, contacts); }));
    }

    void ask_sweeps() {
        const Sphere sphere = this->sphere();
        const Box box = this->box();
        const Vec3 way = step();
        const Capsule capsule = {box.min, box.max, sphere.radius};
        add(measured("sweep_sphere", [&] { return sweep(blob_, sphere, way); }));
        add(measured("sweep_capsule", [&] { return sweep(blob_, capsule, way); }));
        add(measured("sweep_box", [&] { return sweep(blob_, box, way); }));
        const OrientedBox oriented = turned_box(sphere.center, 0.7f * sphere.radius);
        add(measured("sweep_oriented_box", [&] { return sweep(blob_, oriented, way); }));
        const Octahedron octahedron(sphere.center, sphere.radius);
        add(measured("sweep_convex_hull", [&] { return sweep(blob_, octahedron.hull(), way); }));
    }

    void ask_coarsely() {
        const Sphere sphere = this->sphere();
        const Box box = this->box();
        const Ray ray = this->ray();
        const float accuracy = 0.01f * extent();
        add_overlap("may_overlap_sphere", sphere, Accuracy{accuracy});
        add_overlap("may_overlap_box", box, Accuracy{accuracy});
        answers_.add(measured("may_be_occluded", [&] { return occluded(blob_, ray, Accuracy{accuracy}); }).yes());
        const Result<DistanceBounds> bounds = measured(
            "distance_bounds", [&] { return distance_bounds(blob_, sphere.center, infinity, Accuracy{accuracy}); });
        answers_.add(bounds->lower, bounds->upper);
    }

    /// Where a rotation without translation takes a point; the quaternion may have any length.
    static Vec3 turned(const Quaternion& q, const Vec3& p) {
        const float scale = 1.0f / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        const float diagonal = (q.w * q.w - q.x * q.x - q.y * q.y - q.z * q.z) * scale;
        const float along = 2.0f * (q.x * p.x + q.y * p.y + q.z * p.z) * scale;
        const float twice = 2.0f * q.w * scale;
        return {diagonal * p.x + along * q.x + twice * (q.y * p.z - q.z * p.y),
                diagonal * p.y + along * q.y + twice * (q.z * p.x - q.x * p.z),
                diagonal * p.z + along * q.z + twice * (q.x * p.y - q.y * p.x)};
    }

    /// The blob against itself, turned about its middle, so far aside that the boxes overlap by half; for distances,
    /// that they are half their size apart.
    void ask_pairs() {
        Transform placement;
        placement.rotation = {0.5f * symmetric(), 0.5f * symmetric(), 0.5f * symmetric(), 1.0f};
        const Vec3 back = difference(center(), turned(placement.rotation, center()));
        const Vec3 direction = unit_vector();
        const auto aside = [&](float distance) {
            return Vec3{back.x + direction.x * distance * size().x, back.y + direction.y * distance * size().y,
                        back.z + direction.z * distance * size().z};
        };
        placement.translation = aside(0.5f);
        YesNo answer;
        measure_("collides", [&] { answer = overlaps(blob_, {blob_, placement}, WorkLimit::unlimited()); });
        add(answer.status());
        answers_.add(answer.yes());
        std::uint32_t number = 0;
        QueryStatus status{};
        measure_("for_each_contact", [&] {
            const auto visit = [&](const PairContact&) { return ++number < 100 ? Visit::next : Visit::stop; };
            status = for_each_contact(blob_, {blob_, placement}, visit, WorkLimit::unlimited());
        });
        add(status);
        answers_.add(number);
        ask_touches({blob_, placement});
        placement.translation = aside(1.5f);
        const BlobDistance nearest = measured("minimum_distance", [&] {
            return distance(blob_, {blob_, placement}, WorkLimit::unlimited());
        });
        add(nearest.status);
        answers_.add(nearest.distance);
        measure_("within_distance", [&] {
            answer = within_distance(blob_, {blob_, placement}, 0.125f * extent(), WorkLimit::unlimited());
        });
        add(answer.status());
        answers_.add(answer.yes());
    }

    void ask_touches(const PlacedBlob& other) {
        PairTouch touches[8];
        const Filled found =
            measured("collect_touches", [&] { return collect_touches(blob_, other, touches, WorkLimit::unlimited()); });
        add(found.status);
        for (const PairTouch& touch : found.in(touches)) {
            answers_.add(touch.a.index, touch.b.index, touch.depth);
            add(touch.normal);
            for (const Vec3& point : std::span(touch.points).first(touch.count)) add(point);
        }
    }

    std::span<const std::byte> bytes_;
    const Blob& blob_;
    const Measure& measure_;
    Lattice lattice_;
    platform::Fingerprint answers_;
};

}  // namespace espalier::firmware
