// The regions of lattices that several blobs share.
#pragma once

#include <espalier/transform.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

inline constexpr std::int32_t most_steps = (1 << format::max_bits) - 1;

/// How many steps `to` is beyond `from`, of two multiples of the step. False below 0 and beyond most_steps; in between
/// float32 holds the difference exactly.
inline bool whole_steps(float from, float to, float steps_per_unit, std::int32_t& steps) {
    const float difference = (to - from) * steps_per_unit;
    if (!(difference >= 0.0f && difference <= static_cast<float>(most_steps))) return false;
    steps = static_cast<std::int32_t>(difference);
    return true;
}

inline bool is_region(const Lattice& region) {
    if (region.step_exponent < format::min_step_exponent || region.step_exponent > format::max_step_exponent)
        return false;
    const Vec3& o = region.origin;
    for (const float origin : {o.x, o.y, o.z})
        if (!is_finite(origin) || !is_multiple_of_power(origin, region.step_exponent)) return false;
    for (const std::int32_t extent : region.extent)
        if (extent < 0 || extent > most_steps) return false;
    return true;
}

/// Returns ok if a smaller region on the same lattice lies in a region, and how far from its origin.
inline QueryStatus find_in_region(const Lattice& part, const Lattice& region, std::int32_t (&steps)[3]) {
    if (part.step_exponent != region.step_exponent) return QueryStatus::invalid_argument;
    const float steps_per_unit = power_of_two(-part.step_exponent);
    const float from[3] = {region.origin.x, region.origin.y, region.origin.z};
    const float to[3] = {part.origin.x, part.origin.y, part.origin.z};
    for (int k = 0; k < 3; ++k)
        if (!whole_steps(from[k], to[k], steps_per_unit, steps[k]) || steps[k] + part.extent[k] > region.extent[k])
            return QueryStatus::out_of_range;
    return QueryStatus::ok;
}
inline QueryStatus find_in_region(const BlobData& blob, const Lattice& region, std::int32_t (&steps)[3]) {
    const Lattice part = {{blob.origin[0], blob.origin[1], blob.origin[2]},
                          blob.step_exponent,
                          {blob.extent[0], blob.extent[1], blob.extent[2]}};
    return find_in_region(part, region, steps);
}

/// Moves the origin of a region by a transform's translation, backwards. Returns ok, or why that does not work.
inline QueryStatus move_region(const Transform& transform, Lattice& region) {
    const Quaternion& q = transform.rotation;
    // By their bits: flush modes change nothing.
    const bool only_moves = (magnitude_bits(q.x) | magnitude_bits(q.y) | magnitude_bits(q.z)) == 0 &&
                            magnitude_bits(q.w) != 0 && is_finite(q.w) && transform.scale == 1.0f;
    if (!only_moves || !is_region(region)) return QueryStatus::invalid_argument;
    const float from[3] = {region.origin.x, region.origin.y, region.origin.z};
    const float by[3] = {transform.translation.x, transform.translation.y, transform.translation.z};
    float to[3];
    for (int k = 0; k < 3; ++k) {
        if (!is_finite(by[k]) || !is_multiple_of_power(by[k], region.step_exponent))
            return QueryStatus::invalid_argument;
        to[k] = from[k] - by[k];
        // The rounding of a difference (Moeller 1965, Knuth): without any it is exact. NaN where `to` is infinite.
        const float back = from[k] - to[k];
        // mutant(+ -> - 2) equivalent: the two terms are equal only if both are zero
        if ((from[k] - (to[k] + back)) + (back - by[k]) != 0.0f) return QueryStatus::out_of_range;
    }
    region.origin = {to[0], to[1], to[2]};
    return QueryStatus::ok;
}

}  // namespace espalier::detail
