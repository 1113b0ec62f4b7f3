// Rotation, scale and translation of points in float: the one definition of where a placed shape is.
//
// No intermediate result is subnormal, so that flush-to-zero modes change no bit: products below `least` become zero,
// and sums of numbers above it are zero or normal.
#pragma once

#include <cstdint>

#include <espalier/transform.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

inline constexpr float least_coordinate = 0x1p-100f;
inline constexpr std::uint32_t least_coordinate_bits = 27u << 23;
inline constexpr float greatest_scale = 0x1p100f;

/// Returns x, or zero if |x| is below 2^-100.
[[gnu::always_inline]] inline float without_tiny(float x) {
    return magnitude_bits(x) < least_coordinate_bits ? 0.0f : x;
}

/// Applies a function to each coordinate.
template <class Function>
Vec3 for_each_coordinate(const Vec3& v, Function function) {
    return {function(v.x), function(v.y), function(v.z)};
}
inline Vec3 without_tiny(const Vec3& v) {
    return for_each_coordinate(v, [](float x) { return without_tiny(x); });
}
inline Vec3 sum(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

/// Returns whether a transform with that scale is applied.
inline bool is_in_range(float scale) { return scale >= least_coordinate && scale <= greatest_scale; }

inline constexpr float not_a_number = __builtin_nanf("");

/// Returns whether the numbers are finite, the rotation has a length and the scale is above 0.
bool is_valid(const Transform& transform) noexcept;

/// Returns whether the transform is the default one, bit for bit up to the signs of zeros.
bool is_identity(const Transform& transform) noexcept;

inline constexpr int no_exponent = 1000;
/// Scales numbers by a power of two, 2^-e: the greatest is in [1, 2), and those below 2^-40 of it are zero. Returns e,
/// or no_exponent if all numbers are zero or one is not finite. Their products are far from subnormal.
int make_greatest_one(float* numbers, int count) noexcept;
/// Returns such a quaternion; NaN if the quaternion is zero or not finite.
Quaternion with_greatest_of_one(const Quaternion& rotation) noexcept;

/// A transform, ready to be applied.
class PreparedTransform {
public:
    explicit PreparedTransform(const Transform& transform) noexcept;

    /// Rotate only.
    [[nodiscard]] Vec3 rotated_back(const Vec3& v) const noexcept;
    [[nodiscard]] Vec3 rotated(const Vec3& v) const noexcept;

    [[nodiscard]] float length_to_local(float length) const noexcept {
        return without_tiny(without_tiny(length) / scale_);
    }
    [[nodiscard]] float length_to_world(float length) const noexcept {
        return without_tiny(without_tiny(length) * scale_);
    }
    [[nodiscard]] Vec3 direction_to_local(const Vec3& v) const noexcept;
    [[nodiscard]] Vec3 direction_to_world(const Vec3& v) const noexcept;
    [[nodiscard]] Vec3 point_to_local(const Vec3& p) const noexcept;
    [[nodiscard]] Vec3 point_to_world(const Vec3& p) const noexcept;
    [[nodiscard]] const Vec3& translation() const noexcept { return translation_; }

private:
    /// Returns the product of v and the rotation, or its transpose: `row` and `column` are the steps between entries.
    [[nodiscard]] Vec3 multiplied(const Vec3& v, int row, int column) const noexcept;

    float entry_[9];    ///< of the rotation, row by row
    Vec3 translation_;  ///< without tiny coordinates
    float scale_;       ///< NaN if the transform is not valid
};

}  // namespace espalier::detail
