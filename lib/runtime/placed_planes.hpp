// Planes of a node as floats that no conversion makes, for the slab tests of instruction sets that gain by it.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/ray_lanes.hpp>

namespace espalier::detail {

/// Lattice coordinates as floats, without a conversion: coordinate * 2^-(bits + 1) + 1. Its mantissa is the coordinate
/// in 22 bits, so the float's bits are a sum of shifted integers. From 23 bits on the lowest bits are cut off.
namespace placed {

inline constexpr unsigned mantissa_bits = 22;
inline constexpr std::uint32_t one = 0x3F800000u;  ///< the bits of coordinate 0
/// A plane, in the top byte of a word, is shifted right by at least this: then no plane overflows, and planes that
/// are as far apart as the lattice is large still leave it.
inline constexpr std::uint32_t least_shift = 24 - mantissa_bits;
/// How far slab tests move planes outward for the roundings of placed coordinates, in units of the mantissa.
inline constexpr float slack_units = 3.0f;

/// How far a node's base is shifted left.
// mutant(< -> <=) equivalent: both sides are equal then
constexpr std::uint32_t base_shift(unsigned bits) { return mantissa_bits - (bits < 16 ? bits : 16u); }
/// How far a plane in a word's top byte is shifted right, less the shift of its axis.
constexpr std::uint32_t plane_shift(unsigned bits) { return bits + least_shift; }
/// A unit of the mantissa, in lattice steps.
constexpr float unit(unsigned bits) { return power_of_two(static_cast<int>(bits) - static_cast<int>(mantissa_bits)); }
/// By how much a placed coordinate grows in a lattice step, and the inverse.
// mutant(- -> +, - -> right side dropped) work: widens the asset's box alone; nodes refuse the ray later
constexpr float step(unsigned bits) { return power_of_two(-1 - static_cast<int>(bits)); }
constexpr float steps_to_one(unsigned bits) { return power_of_two(1 + static_cast<int>(bits)); }

}  // namespace placed

/// As RayLanes, for placed coordinates: tau of a plane is placed coordinate * inverse + offset.
struct PlacedRayLanes {
    alignas(16) float inverse[4];
    alignas(16) float near_offset[4];
    alignas(16) float far_offset[4];
    float tau_min;  ///< not -0
    std::uint32_t base_shift, plane_shift;
    PlaneOrder planes;
};

inline void spread_ray(const BlobData& blob, const LatticeRay& ray, const RaySlope& slope, PlacedRayLanes& lanes) {
    const float slack_steps = slope.slack_steps + placed::slack_units * placed::unit(blob.bits);
    unsigned signs = 0;
    // mutant(< -> <=) sanitizer: reads behind an array, and writes numbers that mean nothing
    for (unsigned k = 0; k < 3; ++k) {
        const float slack = absolute(slope.inverse[k]) * slack_steps;
        lanes.inverse[k] = slope.inverse[k] * placed::steps_to_one(blob.bits);
        const float middle = -origin_steps(ray, k) * slope.inverse[k] - lanes.inverse[k];
        lanes.near_offset[k] = middle - slack;
        lanes.far_offset[k] = middle + slack;
        signs |= (static_cast<std::uint32_t>(ray.direction[k]) >> 31) << k;
    }
    lanes.tau_min = ray.tau_min + 0.0f;
    lanes.base_shift = placed::base_shift(blob.bits);
    lanes.plane_shift = placed::plane_shift(blob.bits);
    lanes.planes = packed_plane_orders[signs];
}

/// Whether the ray meets the asset's box, widened like the planes of a node.
inline bool meets_asset(const BlobData& blob, const LatticeRay& ray, const PlacedRayLanes& lanes) {
    float enter = ray.tau_min;
    float leave = infinity;
    // mutant(< -> >= 1) work: refuses no ray; nodes do later
    for (unsigned k = 0; k < 3; ++k) {
        const float low = lanes.inverse[k];
        const float high = blob.extent_steps[k] * placed::step(blob.bits) * low + low;
        // mutant(maximum -> minimum) work: enters the box too early; nodes refuse the ray later
        enter = maximum(minimum(low, high) + lanes.near_offset[k], enter);
        // mutant(minimum -> maximum) work: leaves the box too late; nodes refuse the ray later
        leave = minimum(maximum(low, high) + lanes.far_offset[k], leave);
    }
    // mutant(<= -> <) work: refuses a ray that the slack alone brought to the box
    return enter <= leave;
}

}  // namespace espalier::detail
