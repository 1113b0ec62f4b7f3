// Asks a blob everything the runtime can be asked, and hashes every bit that comes back. No heap, no libc, no doubles:
// the same file runs on a server and on a Cortex-M0.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "answer_counts.hpp"
#include "pair_answers.hpp"
#include "questions.hpp"
#include "ray_answers.hpp"

namespace espalier::platform {

/// Edges, bounds and nodes.
inline void read_extras(const Blob& blob, Fingerprint& fingerprint) {
    for (std::uint32_t index = 0; index <= blob.triangle_count(); index += 1 + index / 8) {
        const Result<EdgeKinds> kinds = edge_kinds(blob, {index});
        fingerprint.add(static_cast<bool>(kinds));
        fingerprint.add(static_cast<std::uint32_t>(kinds->ab) << 4 | static_cast<std::uint32_t>(kinds->bc) << 2 |
                        static_cast<std::uint32_t>(kinds->ca));
        const Triangle corners = *triangle_at(blob, {index});
        fingerprint.add(bool(triangle_at(blob, {index})), corners.b);
        const Vec3 normal = fix_internal_edge_normal(blob, {index}, static_cast<Feature>(index % 7), corners.a);
        const bool is_fixed = normal != corners.a;
        fingerprint.add(is_fixed, is_fixed ? normal : Vec3{});
    }
    const Result<Sphere> sphere = bounding_sphere(blob);
    fingerprint.add(static_cast<bool>(sphere), sphere->center, sphere->radius);
    const Result<OrientedBox> box = oriented_bounds(blob);
    fingerprint.add(static_cast<bool>(box), box->center);
    for (const Vec3& axis : box->half_axes) fingerprint.add(axis);
    const Result<KDop> k_dop = k_dop_bounds(blob);
    fingerprint.add(static_cast<bool>(k_dop));
    for (unsigned k = 0; k < KDop::count; ++k) {
        fingerprint.add(k_dop->lo[k], k_dop->hi[k]);
    }
    (void)for_each_node(blob, [&](const TreeNode& node) {
        fingerprint.add(node.number, std::uint32_t{node.depth});
        for (unsigned i = 0; i < node.child_count; ++i) {
            fingerprint.add(node.children[i].box.min, node.children[i].box.max,
                            node.children[i].is_leaf ? node.children[i].first.index : 0u);
        }
        return NodeVisit::descend;
    });
}

/// A miss enters as the zeros of triangle 0, as it did when golden.txt was recorded.
template <class Shape>
void ask_sweep(const Blob& blob, const Shape& shape, Vec3 displacement, Answers& answers) {
    answers.calls += 4;
    const SweepHit filtered =
        sweep(blob, shape, displacement, [](TriangleId triangle) { return triangle.index % 3 != 0; });
    answers.fingerprint.add(bool(filtered), filtered ? filtered.t : 0.0f);
    const SweepHit hit = sweep(blob, shape, displacement);
    answers.fingerprint.add(bool(hit), hit.status, hit ? hit.t : 0.0f, hit.point, hit.normal, hit.starts_overlapping,
                            static_cast<std::uint32_t>(hit.feature));
    add_triangle(answers.fingerprint, blob, hit ? hit.triangle : TriangleId{0});
    SweepOptions options;
    options.culling = FaceCulling::back;
    options.ignore_leaving = true;
    options.skin = 0.125f;
    const SweepHit kept = sweep(blob, shape, displacement, options);
    answers.fingerprint.add(kept.status, kept.t, kept.starts_overlapping);
}

inline constexpr auto ask_sweeps = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Ray ray = questions.ray(number);
    const Vec3 way = number % 8 == 1 || number % 8 == 5 ? questions.displacement(number) : ray.direction;
    const Sphere sphere = questions.sphere(number + 1);
    ask_sweep(blob, Sphere{ray.origin, sphere.radius}, way, answers);
    ask_sweep(blob, Capsule{ray.origin, sphere.center, sphere.radius}, way, answers);
    ask_sweep(blob, Box{ray.origin, {ray.origin.x + sphere.radius, ray.origin.y, ray.origin.z + sphere.radius}}, way,
              answers);
    ask_sweep(blob, questions.box(number), way, answers);
});

/// Oriented boxes and convex hulls that move: the box, and the hull of its center and the ends of its axes and others.
inline constexpr auto ask_hull_sweeps = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Vec3 way = questions.ray(number).direction;
    const OrientedBox box = questions.oriented_box(number);
    ask_sweep(blob, box, way, answers);
    Vec3 vertices[12];
    fill_vertices_around(box, vertices);
    ask_sweep(blob, ConvexHull{std::span<const Vec3>(vertices).first(1 + number % std::size(vertices))}, way, answers);
});

/// The crossings of rays, and the contacts of spheres, capsules, oriented boxes and convex hulls.
inline constexpr auto ask_contacts = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    Contact contacts[16];
    const auto add = [&](const Filled& found) {
        ++answers.calls;
        answers.fingerprint.add(found.status);
        const std::size_t kept = reduce_contacts(found.in(contacts));
        for (const Contact& contact : std::span<const Contact>(contacts).first(kept)) {
            answers.fingerprint.add(contact.point, contact.normal, contact.distance,
                                    static_cast<std::uint32_t>(contact.feature),
                                    static_cast<std::uint32_t>(contact.side));
            add_triangle(answers.fingerprint, blob, contact.triangle);
        }
    };
    ++answers.calls;
    const QueryStatus status = for_each_crossing(blob, questions.ray(number),
                                                 [&](const RayHit& hit) { add_hit(answers.fingerprint, blob, hit); });
    answers.fingerprint.add(status);
    const Sphere sphere = questions.sphere(number);
    const float margin = number % 3 == 0 ? 0.0f : 0.25f * sphere.radius;
    add(find_contacts(blob, sphere, margin, contacts));
    add(find_contacts(blob, questions.capsule(number), margin, contacts));
    const OrientedBox box = questions.oriented_box(number);
    add(find_contacts(blob, box, margin, contacts));
    // The corners of the box that the number does not leave out, and the middle of two more than once.
    Vec3 vertices[12];
    for (unsigned i = 0; i < std::size(vertices); ++i) {
        const unsigned corner = i < 8 ? i : number & 7u;
        vertices[i] = box.center;
        for (unsigned k = 0; k < 3; ++k) {
            const float sense = (corner >> k & 1u) != 0 ? 1.0f : (number >> (i + k) & 1u) != 0 ? 0.0f : -1.0f;
            vertices[i] = {vertices[i].x + sense * box.half_axes[k].x, vertices[i].y + sense * box.half_axes[k].y,
                           vertices[i].z + sense * box.half_axes[k].z};
        }
    }
    add(find_contacts(blob, ConvexHull{std::span<const Vec3>(vertices).first(1 + number % std::size(vertices))}, margin,
                      contacts));
});

/// Visits all overlaps. Returns false if the visitor stopped, or the shape is out of range.
template <class Shape>
bool saw_all(const Blob& blob, const Shape& shape, TriangleVisitor visit) {
    const QueryStatus status = for_each_overlap(blob, shape, visit);
    return status == QueryStatus::ok || status == QueryStatus::invalid_argument;
}

inline constexpr auto ask_spheres = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Sphere sphere = questions.sphere(number);
    std::uint32_t left = 40;
    answers.fingerprint.add(overlaps(blob, sphere).yes());
    const bool all = saw_all(blob, sphere, [&](TriangleId triangle) {
        ++answers.overlaps;
        answers.fingerprint.add(triangle.index);
        return --left == 0 ? Visit::stop : Visit::next;
    });
    ++answers.spheres;
    answers.calls += 2;
    answers.fingerprint.add(all);
});

/// A miss enters as the zeros of triangle 0.
inline void add_nearest(Fingerprint& fingerprint, const Blob& blob, const ClosestPoint& nearest) {
    fingerprint.add(nearest.point, nearest ? nearest.distance : 0.0f, nearest.u, nearest.v,
                    static_cast<std::uint32_t>(nearest.feature));
    add_triangle(fingerprint, blob, nearest ? nearest.triangle : TriangleId{0});
}

template <class Shape>
void ask_volume(const Blob& blob, const Shape& shape, Answers& answers) {
    TriangleId page[3];
    std::uint32_t left = 12;
    answers.calls += 5;
    answers.fingerprint.add(overlaps(blob, shape).yes());
    answers.fingerprint.add(saw_all(blob, shape, [&](TriangleId triangle) {
        ++answers.overlaps;
        answers.fingerprint.add(triangle.index);
        return --left == 0 ? Visit::stop : Visit::next;
    }));
    Cursor from;
    for (int pages = 0; pages < 3; ++pages) {
        const Filled answer = collect_overlaps(blob, shape, page, from);
        answers.fingerprint.add(answer.status, answer.next.place[0]);
        for (const TriangleId triangle : answer.in(page)) answers.fingerprint.add(triangle.index);
        from = answer.next;
    }
}

inline constexpr auto ask_volumes = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    ask_volume(blob, questions.sphere(number), answers);
    ask_volume(blob, questions.capsule(number), answers);
    ask_volume(blob, questions.box(number), answers);
    ask_volume(blob, questions.oriented_box(number), answers);
    ask_volume(blob, questions.corners(number), answers);
    Plane planes[6];
    const std::span<Plane> some = std::span<Plane>(planes).first(1 + number % 6);
    questions.planes(number, some);
    ask_volume(blob, ConvexVolume{some}, answers);
});

inline constexpr auto ask_in_steps = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Lattice lattice = blob.lattice();
    ask_volume(blob, questions.box_in_steps(number), answers);
    const LatticeSegment segment = questions.segment_in_steps(number);
    const LatticeHit hit = raycast(blob, segment);
    answers.calls += 4;
    const auto range = [](QueryStatus status) {  // all that the golden values hold
        return status == QueryStatus::out_of_range ? status : QueryStatus::ok;
    };
    answers.fingerprint.add(range(hit.status), hit ? hit.t : std::uint32_t{0},
                            std::uint32_t{hit && hit.side == Side::back ? 2u : 1u});
    add_triangle(answers.fingerprint, blob, hit.triangle);
    const YesNo any = occluded(blob, segment);
    answers.fingerprint.add(range(any.status()), any.yes());
    const Result<LatticePoint> nearest = to_lattice(lattice, questions.point(number));
    answers.fingerprint.add(nearest.status, to_local(lattice, *nearest));
    const Result<LatticeBox> around = to_lattice(lattice, questions.box(number));
    answers.fingerprint.add(around.status, static_cast<std::uint32_t>(around->min.x),
                            static_cast<std::uint32_t>(around->max.z));
});

inline constexpr auto ask_approximately = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const float accuracy = questions.distance(number + 1) * 0.0625f;
    answers.calls += 4;
    answers.fingerprint.add(overlaps(blob, questions.sphere(number), Accuracy{accuracy}).yes());
    answers.fingerprint.add(overlaps(blob, questions.box(number), Accuracy{accuracy}).yes());
    answers.fingerprint.add(occluded(blob, questions.ray(number), Accuracy{accuracy}).yes());
    const Vec3 point = questions.point(number);
    const Result<DistanceBounds> bounds = distance_bounds(blob, point, questions.distance(number), Accuracy{accuracy});
    answers.fingerprint.add(bool(bounds), bounds ? bounds->lower : 0.0f, bounds ? bounds->upper : 0.0f);
});

inline constexpr auto ask_closest_points = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Vec3 point = questions.point(number);
    const float max_distance = questions.distance(number);
    const ClosestPoint nearest = closest_point(blob, point, max_distance);
    ++answers.points;
    answers.calls += 5;
    answers.points_found += nearest ? 1u : 0u;
    answers.fingerprint.add(bool(nearest));
    add_nearest(answers.fingerprint, blob, nearest);
    ClosestPoint few[4];
    const Filled filled = closest_triangles(blob, point, few, max_distance);
    answers.fingerprint.add(static_cast<std::uint32_t>(filled.count));
    for (const ClosestPoint& each : filled.in(few)) add_nearest(answers.fingerprint, blob, each);
    const YesNo inside = contains(blob, point);
    answers.fingerprint.add(inside.status(), inside.yes());
    const ClosestPoint with_sign = signed_distance(blob, point, max_distance);
    answers.fingerprint.add(with_sign.status);
    // Of a refusal the distance without a sign, 0 if there is none.
    answers.fingerprint.add(!is_refused(with_sign.status) ? with_sign.distance : nearest ? nearest.distance : 0.0f);
    const Result<float> moved = rounding_error(blob, Sphere{point, max_distance});
    answers.fingerprint.add(moved.status, moved.value);
});

inline constexpr auto ask_windings = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Result<float> winding = winding_number(blob, questions.point(number), 6);
    ++answers.calls;
    answers.fingerprint.add(winding.status, winding.value);
});

/// What enters of a closest pair: of a miss its limit as the distance, of a refusal what entered before.
struct PairWords {
    Vec3 on_shape, point;
    float distance = 0.0f, u = 0.0f, v = 0.0f;
    std::uint32_t triangle = 0;

    void add(Fingerprint& fingerprint, const ClosestPoint& pair, float max_distance) {
        if (!is_refused(pair.status)) {
            const float limit = std::bit_cast<float>(std::bit_cast<std::uint32_t>(max_distance) & 0x7FFFFFFFu);
            *this = {pair.on_shape, pair.point, pair ? pair.distance : limit, pair.u, pair.v, pair.triangle.index};
        }
        fingerprint.add(pair.status, on_shape, point, distance, u, v, triangle);
    }
};

inline constexpr auto ask_closest_pairs = repeated([](auto& blob, auto& questions, auto number, auto& answers) {
    const Capsule capsule = questions.capsule(number);
    const float max_distance = questions.distance(number);
    PairWords words;
    answers.calls += 2;
    words.add(answers.fingerprint, closest_point(blob, Segment{capsule.from, capsule.to}, max_distance), max_distance);
    words.add(answers.fingerprint, closest_point(blob, questions.box(number), max_distance), max_distance);
});

/// What `open` tells about the blob, and every triangle in it.
inline void read_all(const Blob& blob, Answers& answers) {
    answers.fingerprint.add(blob.triangle_count(), blob.vertex_count(), blob.size(), blob.checksum(),
                            std::uint32_t{blob.depth()}, std::uint32_t{detail::data_of(blob).bits},
                            std::bit_cast<float>(static_cast<std::uint32_t>(blob.lattice().step_exponent + 127) << 23),
                            blob.max_error(), blob.bounds().min, blob.bounds().max, blob.is_closed());
    if ((detail::data_of(blob).features & format::feature::source_origin) != 0)
        answers.fingerprint.add(blob.source_origin());
    (void)for_each_triangle(blob, [&](TriangleId triangle, const Triangle& corners) {
        add_triangle(answers.fingerprint, blob, triangle);
        answers.fingerprint.add(corners.a, corners.b, corners.c);
        return Visit::next;
    });
}

inline Answers ask_everything(const Blob& blob, std::uint32_t questions_of_a_kind) {
    Answers answers;
    Questions questions(blob);
    read_all(blob, answers);
    read_extras(blob, answers.fingerprint);
    const std::uint32_t each = questions_of_a_kind, quarter = (each + 3) / 4;
    ask_closest_hits(blob, questions, 2 * each, answers);
    ask_filtered_hits(blob, questions, each, answers);
    ask_all_hits(blob, questions, each, answers);
    ask_first_hits(blob, questions, quarter, answers);
    ask_batches(blob, questions, (each + 15) / 16, answers);
    ask_rounded_rays(blob, questions, each, answers);
    ask_sweeps(blob, questions, quarter, answers);
    ask_spheres(blob, questions, each, answers);
    ask_volumes(blob, questions, quarter, answers);
    ask_approximately(blob, questions, quarter, answers);
    ask_closest_points(blob, questions, each, answers);
    ask_closest_pairs(blob, questions, quarter, answers);
    for (std::uint32_t number = 0; number < quarter; ++number) ask_pairs(blob, blob, questions, number, answers);
    ask_in_steps(blob, questions, quarter, answers);
    ask_hull_sweeps(blob, questions, quarter, answers);
    ask_contacts(blob, questions, quarter, answers);
    ask_windings(blob, questions, quarter, answers);
    return answers;
}

}  // namespace espalier::platform
