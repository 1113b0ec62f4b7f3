// A triangle of the lattice, and what the kernels make of it.
#pragma once

#include <cstdint>
#include <type_traits>

#include <runtime/base/options.hpp>
#include <runtime/base/vector3.hpp>

namespace espalier::detail {

/// Corners a, b, c in lattice steps.
struct LatticeTriangle {
    std::int32_t corner[3][3];
};

/// What three numbers take up.
template <class Number>
struct Span {
    Number low, high;
};
template <class Number>
inline Span<Number> span_of(Number a, Number b, Number c) {
    const Number less = a < b ? a : b, more = a < b ? b : a;
    return {less < c ? less : c, more < c ? c : more};
}
inline Span<std::int32_t> span_of(const LatticeTriangle& triangle, int axis) {
    return span_of(triangle.corner[0][axis], triangle.corner[1][axis], triangle.corner[2][axis]);
}

/// Computes a point of the triangle in lattice steps from the weights of corners b and c.
ESPALIER_SHARED_CODE inline void point_of(const LatticeTriangle& triangle, float u, float v, float* point) {
    const auto& corner = triangle.corner;
    for (int k = 0; k < 3; ++k) {
        const float ab = static_cast<float>(corner[1][k] - corner[0][k]);
        const float ac = static_cast<float>(corner[2][k] - corner[0][k]);
        point[k] = static_cast<float>(corner[0][k]) + (u * ab + v * ac);
    }
}

/// The weights of corners b and c at a point of a triangle.
struct Weights {
    float u = 0.0f;
    float v = 0.0f;
};
/// Returns those at a share of a side, 0 from a to b, 1 from b to c, 2 from c to a.
inline Weights weights_on_side(int side, float share) {
    const float rest = 1.0f - share;
    return side == 0 ? Weights{share, 0.0f} : side == 1 ? Weights{rest, share} : Weights{0.0f, rest};
}

/// Corners on a grid of integers. Triangles without area, segments and points, are triangles too.
struct IntegerTriangle {
    Integer3 corner[3];
};
inline Span<std::int64_t> span_of(const IntegerTriangle& triangle, int axis) {
    return span_of(triangle.corner[0][axis], triangle.corner[1][axis], triangle.corner[2][axis]);
}
/// Returns (b - a) x (c - a), which must fit.
inline Integer3 normal_of(const IntegerTriangle& triangle) {
    const auto& c = triangle.corner;
    return cross(c[1] - c[0], c[2] - c[0]);
}
/// Returns a corner in units of 2^-fraction_bits lattice steps: its 24 bits, 6 more at most and a sign fit 32 bits.
inline Integer3 corner_on_grid(const LatticeTriangle& triangle, int number, int fraction_bits) {
    const std::int32_t* corner = triangle.corner[number];
    return {corner[0] << fraction_bits, corner[1] << fraction_bits, corner[2] << fraction_bits};
}
/// Returns a side in lattice steps: 0 from a to b, 1 from b to c, 2 from c to a.
inline Integer3 side_from(const LatticeTriangle& triangle, int number) {
    return corner_on_grid(triangle, number == 2 ? 0 : number + 1, 0) - corner_on_grid(triangle, number, 0);
}
/// Returns the triangle in units of 2^-fraction_bits lattice steps.
ESPALIER_SHARED_CODE inline IntegerTriangle integer_triangle(const LatticeTriangle& triangle, int fraction_bits = 0) {
    IntegerTriangle result;
    for (int i = 0; i < 3; ++i) result.corner[i] = corner_on_grid(triangle, i, fraction_bits);
    return result;
}

/// A hit as the kernel returns it: the caller's result follows by a few divisions.
struct TriangleHit {
    float tau;        ///< within 3 ulp
    float whole_tau;  ///< counted from the caller's origin, within 4 ulp: hits are ordered by this
    float b, c;       ///< weights of corners b and c, times the volume
    float volume;     ///< below 0 if the back was hit; of the magnitude that divides
    float normal[3];  ///< each coordinate rounded
};

/// A triangle as the kernels see it: corner a from the query's origin, in units of 2^-fraction_bits; edges in lattice
/// steps.
struct OriginRelative {
    Integer3 a;
    Integer3 ab;
    Integer3 ac;
};

template <class Point>
ESPALIER_SHARED_CODE inline OriginRelative relative_to(const Point& origin, int fraction_bits,
                                                       const LatticeTriangle& triangle) {
    const auto& c = triangle.corner;
    // In the width of the origin's own coordinates, which suffices: narrow numbers take less room on the stack.
    using Coordinate = std::remove_cvref_t<decltype(origin[0])>;
    const auto from_origin = [&](int k) -> std::int64_t { return (Coordinate{c[0][k]} << fraction_bits) - origin[k]; };
    const auto edge = [&](int to, int k) -> std::int64_t { return c[to][k] - c[0][k]; };
    return {{from_origin(0), from_origin(1), from_origin(2)},
            {edge(1, 0), edge(1, 1), edge(1, 2)},
            {edge(2, 0), edge(2, 1), edge(2, 2)}};
}
template <class Query>
inline OriginRelative relative_to(const Query& query, const LatticeTriangle& triangle) {
    return relative_to(query.origin, query.fraction_bits, triangle);
}

}  // namespace espalier::detail
