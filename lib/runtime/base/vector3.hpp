// Vectors of three integers, of 64 bits or of 128, and the unit vectors along them.
#pragma once

#include <cstdint>
#include <type_traits>

#include <espalier/types.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>
#include <runtime/base/wide_integer.hpp>

namespace espalier::detail {

struct Integer3 {
    std::int64_t x, y, z;

    constexpr std::int64_t& operator[](auto axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr const std::int64_t& operator[](auto axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

inline Integer3 operator-(const Integer3& a) { return {-a.x, -a.y, -a.z}; }
inline Integer3 operator-(const Integer3& a, const Integer3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Integer3 operator+(const Integer3& a, const Integer3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Integer3 operator*(const Integer3& a, std::int64_t by) { return {a.x * by, a.y * by, a.z * by}; }
inline Integer3 operator<<(const Integer3& a, int bits) { return {a.x << bits, a.y << bits, a.z << bits}; }
inline Integer3 smaller(const Integer3& a, const Integer3& b) {
    return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z};
}
inline Integer3 larger(const Integer3& a, const Integer3& b) {
    return {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
}
inline bool is_zero(const Integer3& a) { return (a.x | a.y | a.z) == 0; }
inline Integer3 magnitude(const Integer3& a) { return {magnitude(a.x), magnitude(a.y), magnitude(a.z)}; }
ESPALIER_SHARED_CODE inline std::int64_t sum_of_magnitudes(const Integer3& a) {
    return magnitude(a.x) + magnitude(a.y) + magnitude(a.z);
}
ESPALIER_SHARED_CODE inline Integer3 cross(const Integer3& a, const Integer3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Returns the sum of products in int64 or in 128 bits, which it must fit.
template <class Sum>
Sum dot(const Integer3& a, const Integer3& b);
template <>
ESPALIER_SHARED_CODE inline std::int64_t dot<std::int64_t>(const Integer3& a, const Integer3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <>
ESPALIER_SHARED_CODE inline Int128 dot<Int128>(const Integer3& a, const Integer3& b) {
    return multiply(a.x, b.x) + multiply(a.y, b.y) + multiply(a.z, b.z);
}

/// A vector whose coordinates take more than 64 bits, such as a normal of a large shape.
struct WideVector {
    Int128 x, y, z;

    WideVector operator-() const { return {-x, -y, -z}; }
    WideVector operator-(const WideVector& other) const { return {x - other.x, y - other.y, z - other.z}; }
    WideVector operator*(std::int64_t by) const { return {multiply(x, by), multiply(y, by), multiply(z, by)}; }
    WideVector operator<<(int bits) const { return {x << bits, y << bits, z << bits}; }
};
inline bool is_zero(const WideVector& a) { return a.x.is_zero() && a.y.is_zero() && a.z.is_zero(); }

ESPALIER_SHARED_CODE inline WideVector wide_cross(const Integer3& a, const Integer3& b) {
    return {product_difference(a.y, b.z, a.z, b.y), product_difference(a.z, b.x, a.x, b.z),
            product_difference(a.x, b.y, a.y, b.x)};
}
/// Returns the sum of products, which must fit.
ESPALIER_SHARED_CODE inline Int128 dot(const WideVector& a, const Integer3& b) {
    return multiply(a.x, b.x) + multiply(a.y, b.y) + multiply(a.z, b.z);
}

/// Returns the product in the numbers of that vector, 64 bits or 128, which it must fit.
template <class Vector>
Vector cross_in(const Integer3& a, const Integer3& b) {
    if constexpr (std::is_same_v<Vector, WideVector>) return wide_cross(a, b);
    else return cross(a, b);
}
inline std::int64_t dot(const Integer3& a, const Integer3& b) { return dot<std::int64_t>(a, b); }

inline Vec3 to_unit(const Vec3& v) {
    const float length = square_root(v.x * v.x + v.y * v.y + v.z * v.z);
    return {v.x / length, v.y / length, v.z / length};
}
/// The scale keeps squares of the coordinates from overflowing and from vanishing.
inline Vec3 to_unit(const Integer3& a, float scale = 1.0f) {
    return to_unit(Vec3{to_float(a.x) * scale, to_float(a.y) * scale, to_float(a.z) * scale});
}

}  // namespace espalier::detail
