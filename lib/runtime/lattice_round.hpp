// World coordinates moved into lattice units, and rounded there.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <runtime/float_bits.hpp>
#include <runtime/small_code.hpp>

namespace espalier::detail {

/// A world coordinate in lattice steps from lattice point 0 0 0; infinite where float ends.
ESPALIER_SHARED_CODE inline float to_steps(const BlobData& blob, int axis, float world) {
    return (flush_subnormal(world) - blob.origin[axis]) * blob.steps_per_unit;
}

/// The nearest multiple of 2^-fraction_bits, ties to even, in units of it; |steps| * 2^fraction_bits < 2^62.
ESPALIER_SHARED_CODE inline std::int64_t to_grid(float steps, int fraction_bits) {
    return to_integer(round_to_integer(steps * power_of_two(fraction_bits)));
}

/// A radius >= 0 in lattice steps. No distance between lattice triangles and rounded shapes is in (0, 2^-100): a
/// smaller one is as good as that.
ESPALIER_SHARED_CODE inline float radius_in_steps(const BlobData& blob, float radius) {
    const float steps = scale_by_power_of_two(absolute(radius), -blob.step_exponent);
    // mutant(< -> <=) equivalent: both sides are equal then
    return magnitude_bits(radius) != 0 && steps < 0x1p-100f ? 0x1p-100f : steps;
}
/// False for a NaN and where it is negative; -0 is 0.
ESPALIER_SHARED_CODE inline bool is_radius(float radius) {
    return !is_nan(radius) && (!is_negative(radius) || magnitude_bits(radius) == 0);
}

ESPALIER_SHARED_CODE inline bool is_finite(const Vec3& v) { return is_finite(v.x) && is_finite(v.y) && is_finite(v.z); }
ESPALIER_SHARED_CODE inline bool is_nan(const Vec3& v) { return is_nan(v.x) || is_nan(v.y) || is_nan(v.z); }

/// Whether a coordinate of `min` is above that of `max`; subnormal ones are zero, here as everywhere.
ESPALIER_SHARED_CODE inline bool is_empty(const Box& box) {
    const auto is_above = [](float a, float b) { return flush_subnormal(a) > flush_subnormal(b); };
    return is_above(box.min.x, box.max.x) || is_above(box.min.y, box.max.y) || is_above(box.min.z, box.max.z);
}

}  // namespace espalier::detail
