// World coordinates moved into lattice units, and the grid that a query is rounded to.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// A local coordinate in lattice steps from lattice point 0 0 0; infinite where float ends.
ESPALIER_SHARED_CODE inline float to_steps(const BlobData& blob, int axis, float local) {
    return (flush_subnormal(local) - blob.origin[axis]) * blob.steps_per_unit;
}

/// Returns the nearest multiple of 2^-fraction_bits, ties to even, in units of it; |steps| * 2^fraction_bits < 2^62.
ESPALIER_SHARED_CODE inline std::int64_t to_grid(float steps, int fraction_bits) {
    return to_integer(round_to_integer(steps * power_of_two(fraction_bits)));
}

ESPALIER_SHARED_CODE inline Integer3 to_grid(const float* steps, int fraction_bits) {
    return {to_grid(steps[0], fraction_bits), to_grid(steps[1], fraction_bits), to_grid(steps[2], fraction_bits)};
}
/// Rounds three coordinates to the grid: into its units, and into lattice steps, both exactly. `exact[3]` is zero.
template <class Units>
ESPALIER_SHARED_CODE inline void to_grid(const float* steps, int fraction_bits, Units& units, float* exact) {
    for (int k = 0; k < 3; ++k) {
        const float rounded = round_to_integer(steps[k] * power_of_two(fraction_bits));
        units[k] = to_integer(rounded);
        exact[k] = rounded * power_of_two(-fraction_bits);
    }
    exact[3] = 0.0f;
}

/// Shapes are refused from this distance on, in lattice steps along an axis, to any point of the asset.
inline constexpr float shape_reach = 0x1p36f;

// The largest exponents of coordinates in units of the grid.
inline constexpr int point_grid = 23;  ///< of rays, points and sweeps
inline constexpr int segment_grid = 35;
inline constexpr int volume_grid = 22;  ///< of oriented boxes and triangles
/// Returns the fraction bits of the finest grid, 0 to 6, on which coordinates up to `reach` steps keep to this
/// exponent. Where not even whole steps do, 0: floats that large are whole numbers.
inline int fraction_bits_for(float reach, int largest_exponent) {
    const int spare = largest_exponent - exponent_of(reach);
    // mutant(> -> >=, < -> <=) equivalent: both sides are equal then
    return spare > 6 ? 6 : spare < 0 ? 0 : spare;
}

/// The reach of a query, as its coordinates are moved into lattice steps one by one. A reach is the largest distance to
/// a point of the asset along an axis, or the largest length; it is undefined where a coordinate is not finite.
class Rounder {
public:
    explicit Rounder(const BlobData& blob) : blob_(blob) {}

    /// Moves a point into lattice steps, and extends the reach to it.
    ESPALIER_SHARED_CODE void add_point(const Vec3& local, float* steps) {
        const float from[3] = {local.x, local.y, local.z};
        for (int k = 0; k < 3; ++k) {
            steps[k] = to_steps(blob_, k, from[k]);
            extend(distance(k, steps[k]));
        }
    }
    /// Moves a difference of two points into lattice steps, and extends the reach to its coordinates.
    void add_vector(const Vec3& local, float* steps) {
        steps[0] = add_length(local.x);
        steps[1] = add_length(local.y);
        steps[2] = add_length(local.z);
    }
    ESPALIER_SHARED_CODE float add_length(float local) {
        const float steps = flush_subnormal(flush_subnormal(local) * blob_.steps_per_unit);
        extend(absolute(steps));
        return steps;
    }

    [[nodiscard]] float reach() const { return reach_; }
    void extend(float reach) { reach_ = maximum(reach, reach_); }
    /// Returns the distance of a coordinate from the far end of the asset.
    [[nodiscard]] float distance(int axis, float steps) const {
        return maximum(absolute(steps), absolute(blob_.extent_steps[axis] - steps));
    }

private:
    const BlobData& blob_;
    float reach_ = 0.0f;
};

/// An oriented box in lattice steps.
struct OrientedBoxInSteps {
    float center[3], half[3][3];
    float spread[3] = {};  ///< how far it reaches from its center along each axis of space

    /// Also extends the reach to all of the box.
    OrientedBoxInSteps(const OrientedBox& local, Rounder& rounder) {
        for (int i = 0; i < 3; ++i) {
            rounder.add_vector(local.half_axes[i], half[i]);
            for (int k = 0; k < 3; ++k) spread[k] += absolute(half[i][k]);
        }
        rounder.add_point(local.center, center);
        for (int k = 0; k < 3; ++k) rounder.extend(rounder.distance(k, center[k]) + spread[k]);
    }
    /// Whether it is surely farther than that from the box of the asset.
    [[nodiscard]] bool is_away(const BlobData& blob, float near) const {
        bool is_away = false;
        for (int k = 0; k < 3; ++k) {
            const float last = blob.extent_steps[k];
            const float gap = center[k] < 0.0f ? -center[k] : center[k] > last ? center[k] - last : 0.0f;
            is_away = is_away || gap > (spread[k] + near) * (1.0f + 0x1p-20f) + 4.0f;
        }
        return is_away;
    }
};

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
inline bool is_finite(const OrientedBox& box) {
    const Vec3(&half)[3] = box.half_axes;
    return is_finite(box.center) && is_finite(half[0]) && is_finite(half[1]) && is_finite(half[2]);
}
ESPALIER_SHARED_CODE inline bool is_nan(const Vec3& v) { return is_nan(v.x) || is_nan(v.y) || is_nan(v.z); }

/// Whether a coordinate of `min` is above that of `max`; subnormal ones are zero, here as everywhere.
ESPALIER_SHARED_CODE inline bool is_empty(const Box& box) {
    const auto is_above = [](float a, float b) { return flush_subnormal(a) > flush_subnormal(b); };
    return is_above(box.min.x, box.max.x) || is_above(box.min.y, box.max.y) || is_above(box.min.z, box.max.z);
}

}  // namespace espalier::detail
