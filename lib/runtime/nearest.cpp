// Closest points in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/nearest.hpp>
#include <runtime/closest_pair.hpp>
#include <runtime/lattice_round.hpp>
#include <runtime/nearest_world.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {
namespace detail {

void offer(const BlobData& blob, const FoundNearest& found, ClosestFew& few) { few.offer(to_nearest(blob, found)); }

std::size_t finish(const BlobData& blob, ClosestFew& few, float distance_offset, float max_distance) {
    const std::span<Nearest> found = few.sorted();
    for (Nearest& nearest : found)
        nearest.distance = to_world_distance(blob, nearest.distance, distance_offset, max_distance);
    return found.size();
}

}  // namespace detail

using namespace detail;

namespace {

/// Tells the point on a shape from that on the surface, in lattice steps.
using ToShape = FunctionRef<void(const SegmentDistance& distance, const float* on_surface, float* on_shape)>;

/// Asks about a shape that is prepared.
void find_pair(const BlobData& blob, DistantShape& shape, bool is_empty, float max_distance, NearestPair& pair,
               ToShape to_shape) {
    shape.radius = radius_in_steps(blob, max_distance);
    pair = {};
    pair.triangle = no_triangle;
    pair.distance = absolute(max_distance);
    FoundPair found;
    if (blob.triangle_count == 0 || is_empty || !closest_pair(blob, shape, found)) return;
    const SegmentDistance& distance = found.distance;
    float on_surface[3], on_shape[3];
    point_of(found.triangle, distance.u, distance.v, on_surface);
    to_shape(distance, on_surface, on_shape);
    pair = {to_world(blob, on_shape[0], on_shape[1], on_shape[2]),
            to_world(blob, on_surface[0], on_surface[1], on_surface[2]),
            to_world_distance(blob, distance.squared, 0.0f, max_distance),
            distance.u,
            distance.v,
            Triangle{found.index}};
}

}  // namespace

QueryStatus closest_to_segment(const Blob& blob, const Segment& segment, float max_distance,
                               NearestPair& pair) noexcept {
    if (!is_radius(max_distance)) return QueryStatus::invalid_argument;
    DistantSegment shape;
    const QueryStatus status = round_segment(blob.data(), segment, shape.segment);
    if (status != QueryStatus::ok) return status;
    prepare(shape);
    find_pair(blob.data(), shape, false, max_distance, pair,
              [&](const SegmentDistance& distance, const float*, float* point) {
                  const float rest = 1.0f - distance.along;
                  for (int k = 0; k < 3; ++k)
                      point[k] = rest * shape.segment.from_steps[k] + distance.along * shape.segment.to_steps[k];
              });
    return QueryStatus::ok;
}

QueryStatus closest_to_box(const Blob& blob, const Box& box, float max_distance, NearestPair& pair) noexcept {
    if (!is_radius(max_distance)) return QueryStatus::invalid_argument;
    DistantBox shape;
    const QueryStatus status = round_segment(blob.data(), {box.min, box.max}, shape.diagonal);
    if (status != QueryStatus::ok) return status;
    prepare(shape);
    find_pair(blob.data(), shape, is_empty(box), max_distance, pair,
              [&](const SegmentDistance&, const float* on_surface, float* point) {
                  const float* low = shape.diagonal.from_steps;
                  const float* high = shape.diagonal.to_steps;
                  for (int k = 0; k < 3; ++k)
                      point[k] = on_surface[k] < low[k] ? low[k] : on_surface[k] > high[k] ? high[k] : on_surface[k];
              });
    return QueryStatus::ok;
}

bool closest_point(const Blob& blob, Vec3 point, float max_distance, Nearest& nearest) noexcept {
    LatticePoint rounded;
    FoundNearest found;
    if (blob.triangle_count() == 0 || !round_point(blob.data(), point, max_distance, rounded)) return false;
    if (!ESPALIER_DISPATCH(closest_triangle, blob.data(), rounded, found)) return false;
    nearest = to_nearest(blob.data(), found);
    nearest.distance = to_world_distance(blob.data(), found.distance.squared, rounded.distance_offset, max_distance);
    return true;
}

std::size_t closest_triangles(const Blob& blob, Vec3 point, float max_distance, std::span<Nearest> nearest) noexcept {
    LatticePoint rounded;
    if (blob.triangle_count() == 0 || nearest.empty()) return 0;
    if (!round_point(blob.data(), point, max_distance, rounded)) return 0;
    ClosestFew few(nearest);
    ESPALIER_DISPATCH(closest_triangles, blob.data(), rounded, few);
    return finish(blob.data(), few, rounded.distance_offset, max_distance);
}

}  // namespace espalier
