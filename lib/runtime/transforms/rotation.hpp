// Rotation, scale and translation of points in float: the one definition of where a placed shape is.
//
// No intermediate result is subnormal, so that flush-to-zero modes change no bit: products below `least` become zero,
// and sums of numbers above it are zero or normal.
#pragma once

#include <cstdint>

#include <espalier/transform.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>
#include <runtime/transforms/coordinates.hpp>

namespace espalier::detail {

inline constexpr float least_coordinate = 0x1p-100f;
/// Returns the bits of 2^exponent, a normal number.
constexpr std::uint32_t bits_of_power(int exponent) { return static_cast<std::uint32_t>(exponent + 127) << 23; }
inline constexpr std::uint32_t least_coordinate_bits = bits_of_power(-100);
inline constexpr float greatest_scale = 0x1p100f;

/// Returns x, or zero if |x| is below 2^-100.
ESPALIER_ALWAYS_INLINE inline float without_tiny(float x) {
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

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

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
/// A rotation that is scaled as by with_greatest_of_one().
struct ScaledRotation {
    Coordinates axis;  ///< x y z
    float w;
};

#if ESPALIER_SMALL_CODE

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

#else

ESPALIER_ALWAYS_INLINE inline Coordinates without_tiny(const Coordinates& v) {
    return without_below(v, least_coordinate_bits);
}

/// Returns the rotation, scaled; NaN if the quaternion is zero or not finite.
ESPALIER_ALWAYS_INLINE inline ScaledRotation scaled_rotation(const Quaternion& rotation) {
    const std::uint32_t bits[4] = {magnitude_bits(rotation.x), magnitude_bits(rotation.y), magnitude_bits(rotation.z),
                                   magnitude_bits(rotation.w)};
    const std::uint32_t a = bits[0] > bits[1] ? bits[0] : bits[1], b = bits[2] > bits[3] ? bits[2] : bits[3];
    const std::uint32_t greatest = a > b ? a : b;
    if (greatest - bits_of_power(-60) < bits_of_power(60) - bits_of_power(-60)) [[likely]] {
        // A product is exact, or of a number that is zero below.
        const float factor = std::bit_cast<float>(2 * bits_of_power(0) - (greatest & infinity_bits));
        const Coordinates axis = Coordinates(rotation.x, rotation.y, rotation.z) * Coordinates(factor);
        const Coordinates w = Coordinates(rotation.w) * Coordinates(factor);
        return {without_below(axis, bits_of_power(-40)), without_below(w, bits_of_power(-40))[0]};
    }
    float q[4] = {rotation.x, rotation.y, rotation.z, rotation.w};
    if (make_greatest_one(q, 4) == no_exponent) return {Coordinates(not_a_number), not_a_number};
    return {{q[0], q[1], q[2]}, q[3]};
}

/// A PreparedTransform that computes the coordinates of a vector side by side.
class PreparedTransform {
public:
    ESPALIER_ALWAYS_INLINE explicit PreparedTransform(const Transform& transform)
        : translation_(without_tiny(Coordinates(transform.translation))),
          scale_(is_in_range(transform.scale) ? transform.scale : not_a_number) {
        const ScaledRotation rotation = scaled_rotation(transform.rotation);
        const Coordinates q = rotation.axis, w(rotation.w), two(2.0f);
        const Coordinates squares = q * q, ww = w * w;
        const Coordinates n((squares[0] + squares[1]) + (squares[2] + ww[0]));
        diagonal_ = ((ww + squares) - (squares.in_order<1, 2, 0>() + squares.in_order<2, 0, 1>())) / n;
        const Coordinates symmetric = q * q.in_order<1, 2, 0>(), skew = w * q.in_order<2, 0, 1>();
        above_ = two * (symmetric - skew) / n;
        below_ = two * (symmetric + skew) / n;
    }

    /// Rotate only.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 rotated_back(const Vec3& v) const {
        return turned_back(Coordinates(v)).vector();
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 rotated(const Vec3& v) const { return turned(Coordinates(v)).vector(); }

    [[nodiscard]] float length_to_local(float length) const { return without_tiny(without_tiny(length) / scale_); }
    [[nodiscard]] float length_to_world(float length) const { return without_tiny(without_tiny(length) * scale_); }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 direction_to_local(const Vec3& v) const {
        return local(Coordinates(v)).vector();
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 direction_to_world(const Vec3& v) const {
        return world(Coordinates(v)).vector();
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 point_to_local(const Vec3& p) const {
        return local(without_tiny(Coordinates(p)) - translation_).vector();
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Vec3 point_to_world(const Vec3& p) const {
        return (world(Coordinates(p)) + translation_).vector();
    }
    [[nodiscard]] Vec3 translation() const { return translation_.vector(); }

private:
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Coordinates local(const Coordinates& way) const {
        return without_tiny(without_tiny(turned_back(without_tiny(way))) / Coordinates(scale_));
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Coordinates world(const Coordinates& way) const {
        return turned(without_tiny(without_tiny(way) * Coordinates(scale_)));
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Coordinates turned_back(const Coordinates& v) const {
        return combined(Coordinates::picked<0, 0, 2>(diagonal_, above_, below_),
                        Coordinates::picked<0, 1, 1>(below_, diagonal_, above_),
                        Coordinates::picked<2, 1, 2>(above_, below_, diagonal_), v);
    }
    [[nodiscard]] ESPALIER_ALWAYS_INLINE Coordinates turned(const Coordinates& v) const {
        return combined(Coordinates::picked<0, 0, 2>(diagonal_, below_, above_),
                        Coordinates::picked<0, 1, 1>(above_, diagonal_, below_),
                        Coordinates::picked<2, 1, 2>(below_, above_, diagonal_), v);
    }
    /// Returns the sum of three vectors, each times a coordinate of v.
    ESPALIER_ALWAYS_INLINE static Coordinates combined(const Coordinates& first, const Coordinates& second,
                                                       const Coordinates& third, const Coordinates& v) {
        return without_tiny(first * v.in_order<0, 0, 0>()) + without_tiny(second * v.in_order<1, 1, 1>()) +
               without_tiny(third * v.in_order<2, 2, 2>());
    }

    Coordinates diagonal_ = Coordinates(0.0f);  ///< entries 00 11 22 of the rotation's matrix
    Coordinates above_ = Coordinates(0.0f);     ///< entries 01 12 20
    Coordinates below_ = Coordinates(0.0f);     ///< entries 10 21 02
    Coordinates translation_;                   ///< without tiny coordinates
    float scale_;                               ///< NaN if the transform is not valid
};

#endif

}  // namespace espalier::detail
