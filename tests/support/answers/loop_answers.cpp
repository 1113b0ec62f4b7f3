#include "loop_answers.hpp"

#include <cmath>
#include <utility>

#include <espalier/inside.hpp>
#include <espalier/lattice.hpp>
#include <espalier/nearest.hpp>
#include <espalier/overlap.hpp>
#include <espalier/sweep.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/lattice_segment.hpp>

#include "support/base/same_bits.hpp"
#include "support/queries/ray_maker.hpp"
#include "support/queries/steps_maker.hpp"

namespace espalier::tests {

namespace {

using Difference = std::optional<std::string>;

template <class Rounded, class Shape>
Difference volume(const Blob& blob, const TriangleLoop& loop, const Shape& shape) {
    Rounded rounded;
    const bool answered = round_volume(blob.data(), shape, rounded) == QueryStatus::ok;
    const auto expected = answered && !rounded.is_empty ? loop.every_overlap(rounded) : std::vector<std::uint32_t>();
    std::vector<std::uint32_t> found;
    for_each_overlap(blob, shape, [&](Triangle triangle) {
        found.push_back(triangle.index);
        return keep_going;
    });
    if (found == expected && overlaps(blob, shape) == !expected.empty()) return std::nullopt;
    return "overlaps of " + describe(shape);
}

template <class Distant>
bool is_closest(const Blob& blob, const TriangleLoop& loop, Distant& shape, float max_distance,
                const NearestPair& pair) {
    prepare(shape);
    shape.radius = detail::radius_in_steps(blob.data(), max_distance);
    const auto expected = loop.closest_pair(shape);
    if (!expected) return pair.triangle == no_triangle;
    return pair.triangle.index == expected->index && same_bits(pair.u, expected->distance.u) &&
           same_bits(pair.v, expected->distance.v);
}

Difference segment_distance(const Blob& blob, const TriangleLoop& loop, const Capsule& capsule) {
    const float max_distance = std::fabs(capsule.radius);
    detail::DistantSegment shape;
    NearestPair pair;
    const Segment segment = {capsule.from, capsule.to};
    const QueryStatus status = closest_to_segment(blob, segment, max_distance, pair);
    const bool good =
        status != QueryStatus::ok || (detail::round_segment(blob.data(), segment, shape.segment) == QueryStatus::ok &&
                                      is_closest(blob, loop, shape, max_distance, pair));
    return good ? Difference() : "the distance of a segment, " + describe(capsule);
}

Difference box_distance(const Blob& blob, const TriangleLoop& loop, const Box& box, float max_distance) {
    detail::DistantBox shape;
    NearestPair pair;
    if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) return std::nullopt;
    const bool good = closest_to_box(blob, box, max_distance, pair) != QueryStatus::ok ||
                      (detail::round_segment(blob.data(), {box.min, box.max}, shape.diagonal) == QueryStatus::ok &&
                       is_closest(blob, loop, shape, max_distance, pair));
    return good ? Difference() : "the distance of " + describe(box);
}

template <class Rounded, class Shape>
Difference moving(const Blob& blob, const TriangleLoop& loop, const Moving<Shape>& moving) {
    Rounded rounded;
    detail::FoundContact expected;
    if (round_sweep(blob.data(), moving.shape, moving.displacement, rounded) == QueryStatus::ok)
        expected = loop.first_contact(rounded, [](Triangle) { return true; });
    SweepHit hit;
    const bool found = sweep(blob, moving.shape, moving.displacement, hit);
    bool same = found == (expected.step != detail::no_contact);
    if (found && same) {
        const SweepHit other = to_sweep_hit(blob.data(), rounded, expected);
        same = hit.triangle == other.triangle && same_bits(hit.t, other.t) && same_bits(hit.point, other.point) &&
               same_bits(hit.normal, other.normal);
    }
    return same ? Difference() : "a sweep, " + describe(moving);
}

Difference inside(const Blob& blob, const TriangleLoop& loop, Vec3 point) {
    bool is_inside = false;
    detail::LatticePoint rounded;
    detail::WindingRay ray;
    if (contains(blob, point, is_inside) != QueryStatus::ok) return std::nullopt;
    const bool expected = detail::round_point(blob.data(), point, __builtin_inff(), rounded) &&
                          detail::shortest_way_out(blob.data(), rounded, ray) && loop.winding(ray).is_inside();
    return is_inside == expected ? Difference() : "whether a point is inside, " + describe(Sphere{point, 0.0f});
}

/// A box and a segment in lattice steps, of places in the world.
Difference in_steps(const Blob& blob, const TriangleLoop& loop, ShapeMaker& shapes) {
    const Lattice lattice = lattice_of(blob);
    SegmentInSteps segment;
    const Vec3 from = shapes.point_around(), to = shapes.random().coin() ? shapes.vertex() : shapes.point_around();
    if (to_steps(lattice, from, segment.from) != QueryStatus::ok ||
        to_steps(lattice, to, segment.to) != QueryStatus::ok)
        return std::nullopt;
    HitInSteps hit, expected;
    bool any = false;
    detail::WholeSegment whole;
    if (whole.set(blob.data(), segment)) expected = loop.first_hit(whole);
    const bool answered =
        first_hit(blob, segment, hit) == QueryStatus::ok && any_hit(blob, segment, any) == QueryStatus::ok;
    if (!answered || hit.triangle != expected.triangle || hit.t != expected.t || hit.side != expected.side ||
        any != (hit.triangle != no_triangle))
        return describe(segment);
    const auto ordered = [](std::int32_t& low, std::int32_t& high) {
        if (low > high) std::swap(low, high);
    };
    ordered(segment.from.x, segment.to.x);
    ordered(segment.from.y, segment.to.y);
    ordered(segment.from.z, segment.to.z);
    return volume<detail::LatticeBox>(blob, loop, BoxInSteps{segment.from, segment.to});
}

}  // namespace

std::optional<std::string> loop_difference(const Blob& blob, const TriangleLoop& loop, ShapeMaker& shapes,
                                           SweepMaker& sweeps) {
    const bool awkward = shapes.random().coin();
    const Capsule capsule = shapes.capsule(awkward);
    const Box box = shapes.box(awkward);
    if (auto d = volume<detail::LatticeCapsule>(blob, loop, capsule)) return d;
    if (auto d = volume<detail::LatticeBox>(blob, loop, box)) return d;
    if (auto d = volume<detail::LatticeOrientedBox>(blob, loop, shapes.oriented_box(awkward))) return d;
    if (auto d = volume<detail::LatticeCorners>(blob, loop, shapes.corners(awkward))) return d;
    if (auto d = volume<detail::LatticeHalfSpaces>(blob, loop, shapes.planes(awkward))) return d;
    if (auto d = segment_distance(blob, loop, capsule)) return d;
    if (auto d = box_distance(blob, loop, box, std::fabs(capsule.radius))) return d;
    if (auto d = moving<detail::SphereSweep>(blob, loop, awkward ? sweeps.awkward_sphere() : sweeps.random_sphere()))
        return d;
    if (auto d = moving<detail::CapsuleSweep>(blob, loop, awkward ? sweeps.awkward_capsule() : sweeps.random_capsule()))
        return d;
    if (auto d = moving<detail::BoxSweep>(blob, loop, awkward ? sweeps.awkward_box() : sweeps.random_box())) return d;
    if (auto d = inside(blob, loop, shapes.point_around())) return d;
    return in_steps(blob, loop, shapes);
}

}  // namespace espalier::tests
