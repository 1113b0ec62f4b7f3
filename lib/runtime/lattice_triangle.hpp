// A triangle of the lattice and the vectors of integers that the kernels make of it.
#pragma once

#include <cstdint>
#include <type_traits>

#include <runtime/small_code.hpp>
#include <runtime/wide_integer.hpp>

namespace espalier::detail {

/// Corners a, b, c in lattice steps.
struct LatticeTriangle {
    std::int32_t corner[3][3];
};

/// What a triangle takes up along an axis.
struct Span {
    std::int32_t low, high;
};
inline Span span_of(const LatticeTriangle& triangle, int axis) {
    const std::int32_t a = triangle.corner[0][axis], b = triangle.corner[1][axis], c = triangle.corner[2][axis];
    const std::int32_t less = a < b ? a : b, more = a < b ? b : a;
    return {less < c ? less : c, more < c ? c : more};
}

struct Integer3 {
    std::int64_t x, y, z;
};

/// A hit as the kernel leaves it: what the caller sees of it follows by a few divisions.
struct TriangleHit {
    float tau;        ///< within 3 ulp
    float whole_tau;  ///< counted from the caller's origin, within 4 ulp: hits are ordered by this
    float b, c;       ///< weights of corners b and c, times the volume
    float volume;     ///< > 0
    float normal[3];  ///< each coordinate rounded
};
ESPALIER_SHARED_CODE inline Integer3 cross(const Integer3& a, const Integer3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The sum in int64 where the caller knows that it fits, or in 128 bits.
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

/// A triangle as the kernels see it: corner a from the query's origin, in units of 2^-fraction_bits; edges in lattice
/// steps.
struct OriginRelative {
    Integer3 a;
    Integer3 ab;
    Integer3 ac;
};

template <class Query>
ESPALIER_SHARED_CODE inline OriginRelative relative_to(const Query& query, const LatticeTriangle& triangle) {
    const auto& c = triangle.corner;
    // In the width of the query's own coordinates, which suffices: narrow numbers take less room on the stack.
    using Coordinate = std::remove_cvref_t<decltype(query.origin[0])>;
    const auto from_origin = [&](int k) -> std::int64_t {
        return (Coordinate{c[0][k]} << query.fraction_bits) - query.origin[k];
    };
    const auto edge = [&](int to, int k) -> std::int64_t { return c[to][k] - c[0][k]; };
    return {{from_origin(0), from_origin(1), from_origin(2)},
            {edge(1, 0), edge(1, 1), edge(1, 2)},
            {edge(2, 0), edge(2, 1), edge(2, 2)}};
}

}  // namespace espalier::detail
