// A ray moved into lattice units and rounded there, once. What is rounded here is the query that everything else
// answers exactly: an integer origin on a sub-lattice and an integer direction. docs/numerics.md bounds what the
// rounding moves.
#pragma once

#include <espalier/ray.hpp>
#include <runtime/lattice/rounder.hpp>

namespace espalier::detail {

/// The far end of what is still of interest is widened by this factor, 8 roundings: they cover those of tau.
inline constexpr float interval_slack = 1.0f + 0x1p-21f;

/// Cores without lanes would only lose room on their stacks.
inline constexpr std::size_t lane_alignment = sizeof(void*) < 8 ? 4 : 16;

struct IntegerRay {
    // The ray, exactly: point(tau) = origin * 2^-fraction_bits + tau * direction, in lattice steps from lattice point 0
    // 0 0. What follows each vector fills its register, so that one load fetches it and no room is lost.
    alignas(
        lane_alignment) std::int32_t origin[3];  ///< |origin - 2^fraction_bits * v| <= 2^24 for every lattice point v
    std::int32_t fraction_bits;                  ///< 0..6
    std::int32_t direction[3];                   ///< the largest is in [2^23, 2^24)
    std::int32_t t_exponent;                     ///< see tau_offset

    float tau_min;  ///< >= 0
    float tau_max;  ///< may be infinite

    // Back to the caller: t = (tau_offset + tau) * 2^t_exponent. The offset is not 0 for rays from far away, whose
    // origin was moved along them to the asset.
    float tau_offset;

    std::uint8_t axis[3];  ///< the one with the longest component of the direction last

    FaceCulling culling;
};

/// With what the filters that reject triangles in floats need: the shear that turns the ray into its longest axis, and
/// a bound on the error of sheared coordinates.
struct LatticeRay : IntegerRay {
    float shear[2];
    float shear_error;
    alignas(lane_alignment) float zero[4];  ///< lattice point 0 0 0 from the origin, exactly; the fourth is unused
};

/// All that the queries need of a ray; `Lanes` are what the slab test needs.
template <class Lanes>
struct PreparedRayIn {
    LatticeRay ray;
    Lanes in_lanes;

    [[nodiscard]] const Lanes& lanes() const { return in_lanes; }
};

/// A ray that was rounded for more blobs than this one, on this one's lattice, and the caller's window.
struct RayOnLattice {
    IntegerRay ray;
    float t_min;
    float t_max;
};

/// What is known of a ray once it is rounded and only its test against boxes needs.
struct RaySlope {
    alignas(16) float inverse[4];  ///< 1 / direction, rounded; see `still` for 0. The fourth means nothing
    float slack_steps;             ///< slab_slack of the ray's reach
};

/// The inverse of a component that is zero: every plane that is not exactly at the origin is farther away than any hit,
/// and a plane at the origin is at 0, so that the axis decides by comparison and nothing is ever not a number.
inline constexpr float still = 0x1p60f;

namespace lattice_ray {

/// x, or `instead` where x is +0. In integers: compilers turn a choice before a division into one after it, and then
/// divide by zero, which a program may have trap.
inline float or_if_zero(float x, float instead) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t mask = bits == 0 ? ~0u : 0u;
    return std::bit_cast<float>(bits | (mask & std::bit_cast<std::uint32_t>(instead)));
}

/// Largest distance of a coordinate of the asset's box from the origin, along any axis. As bits: numbers that are not
/// negative are ordered like theirs.
inline std::uint32_t reach_bits(const float* origin, const BlobData& blob) {
    std::uint32_t result = 0;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t to_low = magnitude_bits(origin[k]);
        const std::uint32_t to_high = magnitude_bits(blob.extent_steps[k] - origin[k]);
        // mutant(> -> >=) equivalent: both sides are equal then
        result = to_low > result ? to_low : result;
        // mutant(> -> >=) equivalent: both sides are equal then
        result = to_high > result ? to_high : result;
    }
    return result;
}

/// Moves an origin far outside the asset along the ray to the asset's box, grown by its own size where the lattice has
/// room. False when the ray passes the box by.
ESPALIER_PART_OF_CALLER inline bool approach(const BlobData& blob, IntegerRay& ray, float* origin) {
    std::int32_t largest = 0;
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    // mutant(> -> >=) equivalent: both sides are equal then
    for (int k = 0; k < 3; ++k) largest = blob.extent[k] > largest ? blob.extent[k] : largest;
    const std::int32_t room = (1 << format::max_bits) - 1 - largest;
    // mutant(< -> <=) equivalent: both sides are equal then
    const auto margin = static_cast<float>(largest < room ? largest : room);
    float near = 0.0f;
    float far = infinity;
    int entry = 0;
    for (const bool moves : {false, true}) {
        for (int k = 0; k < 3; ++k) {
            // mutant(< -> <=) equivalent: an axis with direction 0 has no entry, whichever end comes first
            const bool down = ray.direction[k] < 0;
            const auto direction = static_cast<float>(ray.direction[k]);
            const float low = -margin, high = blob.extent_steps[k] + margin;
            const float first = down ? high : low, last = down ? low : high;
            if (moves) {
                const float moved = origin[k] + near * direction;
                // mutant(> -> >= 1, > -> >= 2) equivalent: both sides are equal then
                origin[k] = k == entry ? first : moved > high ? high : moved > low ? moved : low;
            } else if (ray.direction[k] == 0) {
                if (origin[k] < low || origin[k] > high) return false;
            } else {
                const float inverse = 1.0f / direction;
                const float enter = (first - origin[k]) * inverse;
                if (enter > near) {
                    near = enter;
                    entry = k;
                }
                far = minimum((last - origin[k]) * inverse, far);
            }
        }
        if (!(near <= far * interval_slack)) return false;
        if (near == 0.0f) return true;  // already inside the grown box
    }
    ray.tau_offset = near;
    return true;
}

/// t in units of tau; a positive t too small to matter stays positive (no intersection has 0 < tau < 2^-100).
inline float to_tau(float t, int t_exponent) {
    const float tau = scale_by_power_of_two(t, -t_exponent);
    // mutant(< -> <=) equivalent: both sides are equal then
    return magnitude_bits(t) != 0 && tau < 0x1p-100f ? 0x1p-100f : tau;
}

}  // namespace lattice_ray

inline void set_longest_axis(IntegerRay& ray, unsigned axis) {
    constexpr unsigned after = 0b01'00'10'01;  // two bits each: no processor could foresee a branch on it
    ray.axis[0] = static_cast<std::uint8_t>(after >> (2 * axis) & 3u);
    ray.axis[1] = static_cast<std::uint8_t>(after >> (2 * axis + 2) & 3u);
    ray.axis[2] = static_cast<std::uint8_t>(axis);
}

/// Turns the ray into its longest axis, given the inverse of the direction along it.
inline void set_shear(LatticeRay& ray, float inverse, float reach) {
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (int i = 0; i < 2; ++i) ray.shear[i] = static_cast<float>(-ray.direction[ray.axis[i]]) * inverse;
    ray.shear_error = (reach + 1.0f) * (6.0f * 0x1p-24f);
}
/// How far the slab test moves planes outward, in lattice steps: 16 roundings of the reach.
inline float slab_slack(float reach) { return (reach + 1.0f) * 0x1p-20f; }

/// False when the ray can hit nothing: an argument out of the domain, or a ray that passes far by. `reach` is how far
/// the asset is from the origin at most, along any axis, in lattice steps.
ESPALIER_SHARED_CODE inline bool round_ray(const BlobData& blob, const Ray& ray, IntegerRay& rounded, float& reach) {
    // The window, by its bits. A number that is none is above infinity; t_min may be below 0, and t_max -0.
    const auto t_min_bits = std::bit_cast<std::uint32_t>(ray.t_min);
    const std::uint32_t from = t_min_bits & ((t_min_bits >> 31) - 1u);
    const std::uint32_t to = magnitude_bits(ray.t_max);
    if (t_min_bits > (infinity_bits | ~magnitude_mask) || std::bit_cast<std::uint32_t>(ray.t_max) > ~magnitude_mask ||
        to > infinity_bits || from > to)
        return false;

    float direction[3], origin[3];
    static_assert(sizeof ray.direction == sizeof direction);
    ESPALIER_COPY_BYTES(direction, &ray.direction, sizeof direction);
    ESPALIER_COPY_BYTES(origin, &ray.origin, sizeof origin);
    std::uint32_t longest = 0;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t magnitude = magnitude_bits(direction[k]);
        // mutant(> -> >=) equivalent: both sides are equal then
        longest = magnitude > longest ? magnitude : longest;
        origin[k] = to_steps(blob, k, origin[k]);
        if (magnitude_bits(origin[k]) >= magnitude_bits(0x1p120f)) return false;
        // What the last rounding makes zero anyway is zero from here on, so that nothing below is ever subnormal.
        // mutant(< -> <=) equivalent: the value rounds to 0 anyway and no bound differs
        if (magnitude_bits(origin[k]) < magnitude_bits(0x1p-30f)) origin[k] = 0.0f;
    }
    if (longest == 0 || longest >= infinity_bits) return false;

    // The direction as three integers. Its components may be subnormal, so that they are scaled in integers.
    const auto biased = static_cast<int>(longest >> 23);
    const int shift = 150 - (biased != 0 ? biased : 9 - std::countl_zero(longest));
    unsigned longest_axis = 0;
    std::int32_t longest_way = 0;
    for (unsigned k = 0; k < 3; ++k) {
        const auto way = static_cast<std::int32_t>(round_to_integer(scale_by_power_of_two(direction[k], shift)));
        rounded.direction[k] = way;
        // mutant(< -> <=) equivalent: 0 is its own opposite
        const std::int32_t length = way < 0 ? -way : way;
        if (length > longest_way) {
            longest_way = length;
            longest_axis = k;
        }
    }
    set_longest_axis(rounded, longest_axis);
    rounded.tau_offset = 0.0f;
    std::uint32_t reach_bits = lattice_ray::reach_bits(origin, blob);
    if (reach_bits >= magnitude_bits(0x1p23f)) {
        if (!lattice_ray::approach(blob, rounded, origin)) return false;
        reach_bits = lattice_ray::reach_bits(origin, blob);
    }
    reach = std::bit_cast<float>(reach_bits);
    rounded.fraction_bits = fraction_bits_for(reach, point_grid);
    for (int k = 0; k < 3; ++k) {
        const float units = round_to_integer(origin[k] * power_of_two(rounded.fraction_bits));
        rounded.origin[k] = static_cast<std::int32_t>(units);
    }

    rounded.t_exponent = blob.step_exponent + shift;
    const float tau_min = lattice_ray::to_tau(std::bit_cast<float>(from), rounded.t_exponent) - rounded.tau_offset;
    rounded.tau_min = is_negative(tau_min) ? 0.0f : tau_min;
    rounded.tau_max = lattice_ray::to_tau(ray.t_max, rounded.t_exponent) - rounded.tau_offset;
    rounded.culling = ray.culling;
    // -0 is not below 0.
    return std::bit_cast<std::uint32_t>(rounded.tau_max) <= 0x80000000u &&
           magnitude_bits(rounded.tau_min) != infinity_bits;
}
inline void set_slope(LatticeRay& ray, float reach, RaySlope& slope) {
    // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
    for (unsigned k = 0; k < 3; ++k)
        slope.inverse[k] = 1.0f / lattice_ray::or_if_zero(static_cast<float>(ray.direction[k]), 1.0f / still);
    slope.inverse[3] = 0.0f;
    set_shear(ray, slope.inverse[ray.axis[2]], reach);
    slope.slack_steps = slab_slack(reach);
}
inline bool round_ray(const BlobData& blob, const Ray& ray, LatticeRay& rounded, RaySlope& slope) {
    float reach = 0.0f;
    if (!round_ray(blob, ray, rounded, reach)) return false;
    set_slope(rounded, reach, slope);
    return true;
}
inline bool round_ray(const BlobData& blob, const Ray& ray, LatticeRay& rounded) {
    RaySlope slope;
    return round_ray(blob, ray, rounded, slope);
}

/// The origin in lattice steps, exactly.
inline float origin_steps(const IntegerRay& ray, unsigned axis) {
    return static_cast<float>(ray.origin[axis]) * power_of_two(-ray.fraction_bits);
}

/// Bounds where the interval of a box begins that holds a hit in the ray's window.
inline float window_limit(const IntegerRay& ray) { return ray.tau_max * interval_slack + 0.0f; }
/// Bounds where the interval of a box begins that holds a hit no later than `whole_tau`, which counts from the caller's
/// origin (docs/numerics.md, 5).
inline float hit_limit(const IntegerRay& ray, float whole_tau) {
    return (whole_tau * interval_slack - ray.tau_offset) * interval_slack;
}

/// The caller's t, from tau counted from his origin. A hit is decided exactly: rounding must not report it outside of
/// the window that it was found in, that of a Ray or of a RayOnLattice.
template <class Caller>
inline float to_t(const IntegerRay& rounded, float whole_tau, const Caller& ray) {
    // By their bits, as none is negative, but for a t_min, which is 0 then, and what is -0.
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    const std::uint32_t t = bits(scale_by_power_of_two(whole_tau, rounded.t_exponent));
    const std::uint32_t low = is_negative(ray.t_min) ? 0 : bits(ray.t_min);
    if (static_cast<std::int32_t>(magnitude_bits(ray.t_max)) < static_cast<std::int32_t>(t)) return ray.t_max;
    // mutant(< -> <=) equivalent: both sides are equal then
    return std::bit_cast<float>(t < low ? low : t);
}

}  // namespace espalier::detail
