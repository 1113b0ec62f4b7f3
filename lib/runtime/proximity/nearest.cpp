// Closest points in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/distance.hpp>
#include <runtime/answers/nearest_to_world.hpp>
#include <runtime/lanes/dispatch.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/proximity/closest_pair.hpp>
#include <runtime/proximity/point_queries.hpp>

namespace espalier {
namespace detail {

Visit NearestFew::take_found(Answer& self, const Found& found) {
    const BlobData& blob = static_cast<NearestFew&>(self).blob;
    ClosestFew& few = static_cast<NearestFew&>(self).few;
    const auto& nearest = static_cast<const FoundNearest&>(found);
    if (few.has(blob, nearest.index)) return Visit::next;
    few.offer(unfinished(nearest));
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
using ToShape = FunctionRef<void(const SegmentDistance& distance, const float* on_surface, float* on_shape)>;

/// The line that decides on which side of a triangle a shape lies: all of the shape is behind if both its ends are.
using ToLine = FunctionRef<UnitSegment(const LatticeTriangle& triangle)>;

/// Writes a pair that was found. Out of line, so that its variables are not on the stack during the walk.
[[gnu::noinline]] void finish_pair(const BlobData& blob, const FoundPair& found, float max_distance, ClosestPoint& pair,
                                   ToShape to_shape, ToLine to_line) {
    const SegmentDistance& distance = found.distance;
    float on_surface[3], on_shape[3];
    point_of(found.triangle, distance.u, distance.v, on_surface);
    to_shape(distance, on_surface, on_shape);
    pair.point = to_world(blob, on_surface[0], on_surface[1], on_surface[2]);
    pair.on_shape = to_world(blob, on_shape[0], on_shape[1], on_shape[2]);
    pair.face_normal = face_normal_of(found.triangle);
    pair.distance = to_world_distance(blob, distance.squared, 0.0f, max_distance);
    pair.u = distance.u;
    pair.v = distance.v;
    pair.triangle = TriangleId{found.index};
    pair.status = QueryStatus::ok;
    pair.feature = distance.feature;
    const UnitSegment line = to_line(found.triangle);
    const auto is_behind = [&](const Integer3& point) {
        return is_origin_behind(relative_to(point, line.fraction_bits, found.triangle));
    };
    if (is_behind(line.from) && is_behind(line.to)) pair.side = Side::back;
}

/// Writes the pair that is closest to a shape that is prepared.
void find_pair(const BlobData& blob, DistantShape& shape, float max_distance, ClosestPoint& pair, ToShape to_shape,
               ToLine to_line) {
    pair.status = QueryStatus::not_found;
    if (blob.triangle_count == 0) return;
    shape.radius = radius_in_steps(blob, max_distance);
    FoundPair found;
    Closest<FoundPair> closest(found);
    find_nearest(blob, shape, closest);
    if (closest.found()) finish_pair(blob, found, max_distance, pair, to_shape, to_line);
}

/// Rounds a segment, or the diagonal of a box. Returns ok, or why the query is refused.
QueryStatus round_pair(const BlobData& blob, const Segment& segment, float max_distance, RoundedSegment& rounded) {
    if (blob.bytes == nullptr) return QueryStatus::not_open;
    if (!is_radius(max_distance)) return QueryStatus::invalid_argument;
    return round_segment(blob, segment, rounded);
}

}  // namespace

ClosestPoint closest_point(const Blob& blob, const Segment& segment, float max_distance) noexcept {
    ClosestPoint pair;
    DistantSegment shape;
    pair.status = round_pair(data_of(blob), segment, max_distance, shape.segment);
    if (pair.status != QueryStatus::ok) return pair;
    prepare(shape);
    find_pair(
        data_of(blob), shape, max_distance, pair,
        [&](const SegmentDistance& distance, const float*, float* point) {
            const float rest = 1.0f - distance.along;
            for (int k = 0; k < 3; ++k)
                point[k] = rest * shape.segment.from_steps[k] + distance.along * shape.segment.to_steps[k];
        },
        [&](const LatticeTriangle&) -> UnitSegment { return shape.segment; });
    return pair;
}

ClosestPoint closest_point(const Blob& blob, const Box& box, float max_distance) noexcept {
    ClosestPoint pair;
    DistantBox shape;
    pair.status = round_pair(data_of(blob), {box.min, box.max}, max_distance, shape.diagonal);
    if (pair.status == QueryStatus::ok && is_empty(box)) pair.status = QueryStatus::not_found;
    if (pair.status != QueryStatus::ok) return pair;
    prepare(shape);
    find_pair(
        data_of(blob), shape, max_distance, pair,
        [&](const SegmentDistance&, const float* on_surface, float* point) {
            const float* low = shape.diagonal.from_steps;
            const float* high = shape.diagonal.to_steps;
            for (int k = 0; k < 3; ++k)
                point[k] = on_surface[k] < low[k] ? low[k] : on_surface[k] > high[k] ? high[k] : on_surface[k];
        },
        [&](const LatticeTriangle& triangle) { return diagonal_across(shape.diagonal, triangle); });
    return pair;
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
    nearest = unfinished(found);
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

}  // namespace espalier
