// Closest points in the caller's units: rounded, answered in lattice units, translated back.
#include <espalier/nearest.hpp>
#include <runtime/closest_few.hpp>
#include <runtime/nearest_world.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/simd/dispatch.hpp>

namespace espalier {
namespace detail {

void ClosestFew::offer(const FoundNearest& found) { kept_.offer(to_nearest(blob_, found)); }

std::size_t ClosestFew::finish(float distance_offset, float max_distance) {
    kept_.sort();
    for (Nearest& nearest : places_.first(kept_.count()))
        nearest.distance = to_world_distance(blob_, nearest.distance, distance_offset, max_distance);
    return kept_.count();
}

}  // namespace detail

using namespace detail;

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
    ClosestFew few(blob.data(), nearest);
    ESPALIER_DISPATCH(closest_triangles, blob.data(), rounded, few);
    return few.finish(rounded.distance_offset, max_distance);
}

}  // namespace espalier
