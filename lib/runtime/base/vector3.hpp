// Vectors of three integers, of 64 bits or of 128.
#pragma once

#include <cstdint>

#include <runtime/base/small_code.hpp>
#include <runtime/base/wide_integer.hpp>

namespace espalier::detail {

struct Integer3 {
    std::int64_t x, y, z;
};

inline Integer3 operator-(const Integer3& a, const Integer3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Integer3 operator+(const Integer3& a, const Integer3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
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
};

ESPALIER_SHARED_CODE inline WideVector wide_cross(const Integer3& a, const Integer3& b) {
    const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
        return multiply(p, q) - multiply(r, s);
    };
    return {minor(a.y, b.z, a.z, b.y), minor(a.z, b.x, a.x, b.z), minor(a.x, b.y, a.y, b.x)};
}
/// Returns the sum of products, which must fit.
ESPALIER_SHARED_CODE inline Int128 dot(const WideVector& a, const Integer3& b) {
    return multiply(a.x, b.x) + multiply(a.y, b.y) + multiply(a.z, b.z);
}

}  // namespace espalier::detail
