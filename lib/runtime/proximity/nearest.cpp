// Closest points in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/approximate.hpp>
#include <espalier/distance.hpp>
#include <runtime/answers/nearest_to_local.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/proximity/queries.hpp>
#include <runtime/traversal/small_boxes.hpp>

#define ESPALIER_FRAGMENT <runtime/proximity/pair_search.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier {
namespace detail {

Visit NearestFew::take_found(Answer& self, const Found& found) {
    const BlobData& blob = static_cast<NearestFew&>(self).blob;
    ClosestFew& few = static_cast<NearestFew&>(self).few;
    const auto& nearest = static_cast<const FoundNearest&>(found);
    if (few.has(blob, nearest.index)) return Visit::next;
    ClosestPoint candidate;
    set_unfinished(candidate, nearest);
    few.offer(candidate);
    if (few.is_full()) {
        self.worst = few.largest_key();
        self.lower_limit(few.largest_key());
    }
    return Visit::next;
}

}  // namespace detail

using namespace detail;

namespace {

/// Computes the point of a shape that is closest to the surface, in lattice steps.
void find_point_on(const DistantShape& shape, float along, const float* on_surface, float* on_shape) {
    const float* from = shape.segment.from_steps;
    const float* to = shape.segment.to_steps;
    const float rest = 1.0f - along;
    for (int k = 0; k < 3; ++k) {
        const float at = on_surface[k];
        on_shape[k] = !shape.is_box ? rest * from[k] + along * to[k] : at < from[k] ? from[k] : at > to[k] ? to[k] : at;
    }
}

/// Writes a pair that was found. Out of line, so that its variables are not on the stack during the walk.
ESPALIER_NOINLINE void finish_pair(const BlobData& blob, const DistantShape& shape, const FoundPair& found,
                                   float max_distance, ClosestPoint& pair) {
    const SegmentDistance& distance = found.distance;
    const Vec3 place = point_of(found.triangle, distance.u, distance.v);
    const float on_surface[3] = {place.x, place.y, place.z};
    float on_shape[3];
    find_point_on(shape, distance.along, on_surface, on_shape);
    pair.point = to_local(blob, on_surface[0], on_surface[1], on_surface[2]);
    pair.on_shape = to_local(blob, on_shape[0], on_shape[1], on_shape[2]);
    pair.face_normal = face_normal_of(found.triangle);
    pair.distance = to_local_distance(blob, distance.squared, 0.0f, max_distance);
    pair.u = distance.u;
    pair.v = distance.v;
    pair.triangle = TriangleId{found.index};
    pair.status = QueryStatus::ok;
    pair.feature = distance.feature;
    // All of the shape is behind the triangle if both ends of this line are.
    UnitSegment line = shape.segment;
    if (shape.is_box) line = diagonal_across(line, found.triangle);
    const auto is_behind = [&](const Integer3& point) {
        return is_origin_behind(relative_to(point, line.fraction_bits, found.triangle));
    };
    if (is_behind(line.from) && is_behind(line.to)) pair.side = Side::back;
}

/// Finds the pair that is closest to a segment, or to a box by its diagonal.
template <class Distant>
ClosestPoint closest_pair(const BlobData& blob, const Segment& segment, float max_distance, bool is_empty) {
    ClosestPoint pair;
    if (blob.bytes == nullptr) return pair;
    Distant shape;
    pair.status = is_radius(max_distance) ? round_segment(blob, segment, shape.segment) : QueryStatus::invalid_argument;
    if (pair.status != QueryStatus::ok) return pair;
    pair.status = QueryStatus::not_found;
    if (is_empty || blob.triangle_count == 0) return pair;
    prepare(shape);
    shape.radius = radius_in_steps(blob, max_distance);
    FoundPair found;
    Closest<FoundPair> closest(found);
    ESPALIER_DISPATCH(find_nearest_pair, blob, shape, closest);
    if (closest.found()) finish_pair(blob, shape, found, max_distance, pair);
    return pair;
}

}  // namespace

ClosestPoint detail::closest_to_segment(const Blob& blob, const Segment& segment, float max_distance) noexcept {
    return closest_pair<DistantSegment>(data_of(blob), segment, max_distance, false);
}

ClosestPoint detail::closest_to_box(const Blob& blob, const Box& box, float max_distance) noexcept {
    return closest_pair<DistantBox>(data_of(blob), {box.min, box.max}, max_distance, is_empty(box));
}

ClosestPoint closest_point(const Blob& blob, Vec3 point, float max_distance) noexcept {
    ClosestPoint nearest;
    RoundedPoint rounded;
    nearest.status = round_query(data_of(blob), point, max_distance, rounded);
    if (nearest.status != QueryStatus::ok) return nearest;
    FoundNearest found;
    Closest<FoundNearest> closest(found);
    ESPALIER_DISPATCH(find_nearest, data_of(blob), rounded, closest, exactly);
    nearest.status = QueryStatus::not_found;
    if (!closest.found()) return nearest;
    set_unfinished(nearest, found);
    finish(data_of(blob), rounded, point, max_distance, nearest);
    return nearest;
}

Filled closest_triangles(const Blob& blob, Vec3 point, std::span<ClosestPoint> nearest, float max_distance) noexcept {
    Filled filled;
    RoundedPoint rounded;
    filled.status = round_query(data_of(blob), point, max_distance, rounded);
    if (is_refused(filled.status)) return filled;
    const bool is_hopeless = filled.status == QueryStatus::not_found || nearest.empty();
    filled.status = QueryStatus::ok;
    if (is_hopeless) return filled;
    ClosestFew few(nearest);
    NearestFew answer(data_of(blob), few);
    ESPALIER_DISPATCH(find_nearest, data_of(blob), rounded, answer, exactly);
    const std::span<ClosestPoint> found = few.sorted();
    for (ClosestPoint& each : found) finish(data_of(blob), rounded, point, max_distance, each);
    filled.count = found.size();
    return filled;
}

Result<DistanceBounds> distance_bounds(const Blob& blob, Vec3 point, float max_distance, Accuracy accuracy,
                                       QueryCounters* counters) noexcept {
    Result<DistanceBounds> bounds;
    RoundedPoint rounded;
    bounds.status = round_query(data_of(blob), point, max_distance, rounded);
    if (bounds.status != QueryStatus::ok) return bounds;
    Bounds answer;
    ESPALIER_DISPATCH(find_nearest, data_of(blob), rounded, answer,
                      WalkAccuracy{steps_in(data_of(blob), accuracy.distance), counters});
    const SquaredBounds& squared = answer.squared;
    bounds.status = QueryStatus::not_found;
    if (squared.lower == infinity) return bounds;
    // Roundings of squares, sums, roots and what a far point was moved by: covered 16 times.
    const auto distance = [&](float square, float slack) {
        return scale_by_power_of_two((square_root(square) + rounded.distance_offset) * slack,
                                     data_of(blob).step_exponent);
    };
    const float lower = distance(squared.lower, 1.0f - 0x1p-18f);
    bounds.value = {magnitude_bits(max_distance) < magnitude_bits(lower) ? max_distance : lower,
                    distance(squared.upper, 1.0f + 0x1p-18f)};
    bounds.status = QueryStatus::ok;
    return bounds;
}

}  // namespace espalier
