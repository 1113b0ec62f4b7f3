// The distance of the surface from both sides, by a walk that stops at small boxes, in the caller's units.
#include <espalier/approximate.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/proximity/point_queries.hpp>
#include <runtime/traversal/small_boxes.hpp>

namespace espalier {

using namespace detail;

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
