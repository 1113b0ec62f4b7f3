// Lattice points back in the local space of the blob, to the nearest float or outward.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// origin + steps * 2^step_exponent, rounded twice at most. Subnormal numbers become zero, whether the machine would
/// flush them or not: they are far below any lattice step.
ESPALIER_SHARED_CODE inline Vec3 to_local(const BlobData& blob, float x, float y, float z) {
    const float step = power_of_two(blob.step_exponent);
    const auto coordinate = [&](int axis, float steps) {
        return flush_subnormal(blob.origin[axis] + flush_subnormal(steps * step));
    };
    return {coordinate(0, x), coordinate(1, y), coordinate(2, z)};
}
ESPALIER_SHARED_CODE inline Vec3 to_local(const BlobData& blob, const std::int32_t* point) {
    return to_local(blob, static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]));
}

/// Returns the corners in local space, rounded to float.
ESPALIER_SHARED_CODE inline Triangle corners_of(const BlobData& blob, const LatticeTriangle& triangle) {
    return {to_local(blob, triangle.corner[0]), to_local(blob, triangle.corner[1]), to_local(blob, triangle.corner[2])};
}

// Floats moved outward by one step, so that what holds for exact numbers holds for rounded ones. Independent of whether
// the machine flushes subnormal numbers: none are made.

/// The next larger float that is normal; infinity stays. x is a number.
inline float next_above(float x) {
    if (magnitude_bits(x) < 0x00800000u) return 0x1p-126f;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    if (bits == infinity_bits) return x;
    return flush_subnormal(std::bit_cast<float>(is_negative(x) ? bits - 1 : bits + 1));
}
inline float next_below(float x) { return -next_above(-x); }

/// An upper and a lower bound of a lattice coordinate, from 0 to 2^27 steps, in local space: of the exact one and of
/// the one that to_local gives.
inline float world_above(const BlobData& blob, int axis, std::int32_t steps) {
    auto whole = static_cast<float>(steps);
    if (steps > 1 << 24) whole = next_above(whole);
    return next_above(flush_subnormal(blob.origin[axis] + whole * power_of_two(blob.step_exponent)));
}
inline float world_below(const BlobData& blob, int axis, std::int32_t steps) {
    auto whole = static_cast<float>(steps);
    if (steps > 1 << 24) whole = next_below(whole);
    return next_below(flush_subnormal(blob.origin[axis] + whole * power_of_two(blob.step_exponent)));
}

}  // namespace espalier::detail
