// Queries that stop at small boxes, in the caller's units.
#include <espalier/approximate.hpp>
#include <runtime/lattice_box.hpp>
#include <runtime/point_queries.hpp>
#include <runtime/ray_queries.hpp>
#include <runtime/simd/dispatch.hpp>
#include <runtime/small_boxes.hpp>

namespace espalier {

using namespace detail;

bool may_overlap(const Blob& blob, const Sphere& sphere, float accuracy, QueryCounters* counters) noexcept {
    LatticePoint rounded;
    QueryCounters unread;
    return blob.triangle_count() != 0 && round_point(blob.data(), sphere.center, sphere.radius, rounded) &&
           ESPALIER_DISPATCH(may_overlap, blob.data(), rounded, steps_in(blob.data(), accuracy),
                             counters != nullptr ? *counters : unread);
}

bool may_overlap(const Blob& blob, const Box& box, float accuracy, QueryCounters* counters) noexcept {
    LatticeBox rounded;
    QueryCounters unread;
    return blob.triangle_count() != 0 && round_volume(blob.data(), box, rounded) == QueryStatus::ok &&
           !rounded.is_empty &&
           may_meet(blob.data(), rounded, steps_in(blob.data(), accuracy), counters != nullptr ? *counters : unread);
}

bool may_be_occluded(const Blob& blob, const Ray& ray, float accuracy, QueryCounters* counters) noexcept {
    QueryCounters unread;
    return blob.triangle_count() != 0 &&
           ESPALIER_DISPATCH_RAY(may_hit, blob.data(), ray, steps_in(blob.data(), accuracy),
                                 counters != nullptr ? *counters : unread);
}

bool distance_bounds(const Blob& blob, Vec3 point, float max_distance, float accuracy, DistanceBounds& bounds,
                     QueryCounters* counters) noexcept {
    LatticePoint rounded;
    QueryCounters unread;
    if (blob.triangle_count() == 0 || !round_point(blob.data(), point, max_distance, rounded)) return false;
    const SquaredBounds squared =
        ESPALIER_DISPATCH(closest_bounds, blob.data(), rounded, steps_in(blob.data(), accuracy),
                          counters != nullptr ? *counters : unread);
    if (squared.lower == infinity) return false;
    // Roundings of squares, sums, roots and what a far point was moved by: covered 16 times.
    const auto distance = [&](float square, float slack) {
        return scale_by_power_of_two((square_root(square) + rounded.distance_offset) * slack,
                                     blob.data().step_exponent);
    };
    const float lower = distance(squared.lower, 1.0f - 0x1p-18f);
    bounds = {magnitude_bits(max_distance) < magnitude_bits(lower) ? max_distance : lower,
              distance(squared.upper, 1.0f + 0x1p-18f)};
    return true;
}

}  // namespace espalier
