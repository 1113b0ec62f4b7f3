#include "loop_answers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <espalier/distance.hpp>
#include <espalier/advanced/lattice.hpp>
#include <espalier/sweep.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_segment.hpp>

#include "support/base/same_bits.hpp"
#include "support/queries/steps_maker.hpp"

namespace espalier::tests {

namespace {

using Difference = std::optional<std::string>;

template <class Shape, class Rounded = detail::Rounded<Shape>>
Difference volume(const Blob& blob, const TriangleLoop& loop, const Shape& shape) {
    Rounded rounded;
    const bool answered = round_volume(detail::data_of(blob), shape, rounded) == QueryStatus::ok;
    const auto expected = answered ? loop.every_overlap(rounded) : std::vector<std::uint32_t>();
    std::vector<std::uint32_t> found;
    (void)for_each_overlap(blob, shape, [&](TriangleId triangle) { found.push_back(triangle.index); });
    if (blob.duplicate_reference_count() != 0) std::sort(found.begin(), found.end());
    if (found == expected && overlaps(blob, shape).yes() == !expected.empty()) return std::nullopt;
    return "overlaps of " + describe(shape);
}

template <class Distant>
bool is_closest(const Blob& blob, const TriangleLoop& loop, Distant& shape, float max_distance,
                const ClosestPoint& pair) {
    prepare(shape);
    shape.radius = detail::radius_in_steps(detail::data_of(blob), max_distance);
    const auto expected = loop.closest_pair(shape);
    if (!expected) return pair.status == QueryStatus::not_found && pair.triangle == no_triangle;
    return pair && pair.triangle.index == expected->index && same_bits(pair.u, expected->distance.u) &&
           same_bits(pair.v, expected->distance.v) && pair.feature == expected->distance.feature;
}

Difference segment_distance(const Blob& blob, const TriangleLoop& loop, const Capsule& capsule) {
    const float max_distance = std::fabs(capsule.radius);
    detail::DistantSegment shape;
    const Segment segment = {capsule.from, capsule.to};
    const ClosestPoint pair = closest_point(blob, segment, max_distance);
    const bool good = is_refused(pair.status) ||
                      (detail::round_segment(detail::data_of(blob), segment, shape.segment) == QueryStatus::ok &&
                       is_closest(blob, loop, shape, max_distance, pair));
    return good ? Difference() : "the distance of a segment, " + describe(capsule);
}

Difference box_distance(const Blob& blob, const TriangleLoop& loop, const Box& box, float max_distance) {
    detail::DistantBox shape;
    if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) return std::nullopt;
    const ClosestPoint pair = closest_point(blob, box, max_distance);
    const bool good = is_refused(pair.status) || (detail::round_segment(detail::data_of(blob), {box.min, box.max},
                                                                        shape.segment) == QueryStatus::ok &&
                                                  is_closest(blob, loop, shape, max_distance, pair));
    return good ? Difference() : "the distance of " + describe(box);
}

template <class Shape>
Difference moving(const Blob& blob, const TriangleLoop& loop, const Moving<Shape>& moving) {
    auto rounded = sweep_of(moving.shape);
    detail::FoundContact expected;
    if (round_sweep(detail::data_of(blob), moving.shape, moving.displacement, rounded) == QueryStatus::ok)
        expected = loop.first_contact(rounded, [](TriangleId) { return true; });
    const SweepHit hit = sweep(blob, query_shape(moving.shape), moving.displacement);
    bool same = bool(hit) == (expected.tick != detail::no_contact);
    if (hit && same) {
        const SweepHit other = to_sweep_hit(detail::data_of(blob), rounded, expected);
        same = hit.triangle == other.triangle && same_bits(hit.t, other.t) && same_bits(hit.point, other.point) &&
               same_bits(hit.normal, other.normal) && hit.feature == other.feature;
    }
    return same ? Difference() : "a sweep, " + describe(moving);
}

Difference inside(const Blob& blob, const TriangleLoop& loop, Vec3 point) {
    detail::RoundedPoint rounded;
    detail::WindingRay ray;
    const YesNo is_inside = contains(blob, point);
    if (is_refused(is_inside.status())) return std::nullopt;
    const bool expected = detail::round_point(detail::data_of(blob), point, infinity, rounded) == QueryStatus::ok &&
                          detail::shortest_way_out(detail::data_of(blob), rounded, ray) &&
                          loop.winding(ray).is_inside();
    return is_inside == YesNo::of(expected) ? Difference()
                                            : "whether a point is inside, " + describe(Sphere{point, 0.0f});
}

/// A box and a segment in lattice steps, of places in the world.
Difference in_steps(const Blob& blob, const TriangleLoop& loop, ShapeMaker& shapes) {
    const Lattice lattice = blob.lattice();
    const Vec3 from = shapes.point_around(), to = shapes.random().coin() ? shapes.vertex() : shapes.point_around();
    const Result<LatticePoint> begin = to_lattice(lattice, from), end = to_lattice(lattice, to);
    if (!begin || !end) return std::nullopt;
    LatticeSegment segment = {*begin, *end};
    LatticeHit expected;
    detail::WholeSegment whole;
    if (whole.set(detail::data_of(blob), segment) == QueryStatus::ok) expected = loop.first_hit(whole);
    else expected.status = QueryStatus::invalid_argument;
    const LatticeHit hit = raycast(blob, segment);
    if (hit.status != expected.status || hit.triangle != expected.triangle || hit.t != expected.t ||
        hit.side != expected.side || occluded(blob, segment).status() != hit.status)
        return describe(segment);
    const auto ordered = [](std::int32_t& low, std::int32_t& high) {
        if (low > high) std::swap(low, high);
    };
    ordered(segment.from.x, segment.to.x);
    ordered(segment.from.y, segment.to.y);
    ordered(segment.from.z, segment.to.z);
    return volume<LatticeBox, detail::Rounded<Box>>(blob, loop, {segment.from, segment.to});
}

}  // namespace

std::optional<std::string> loop_difference(const Blob& blob, const TriangleLoop& loop, ShapeMaker& shapes,
                                           SweepMaker& sweeps) {
    const bool awkward = shapes.random().coin();
    Difference first;
    const auto add = [&](Difference difference) {
        if (!first) first = std::move(difference);
    };
    shapes.make_volumes(awkward, [&](const auto& shape) { add(volume(blob, loop, shape)); });
    const Capsule capsule = shapes.capsule(awkward);
    add(segment_distance(blob, loop, capsule));
    add(box_distance(blob, loop, shapes.box(awkward), std::fabs(capsule.radius)));
    sweeps.make_shapes(awkward, [&](const auto& each, int) { add(moving(blob, loop, each)); });
    add(inside(blob, loop, shapes.point_around()));
    add(in_steps(blob, loop, shapes));
    return first;
}

}  // namespace espalier::tests
