// Vectors of integers, of 64 bits or of 128, and of floats; triangles of the lattice.
#pragma once

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
/// Returns the number of the axis along which a vector is longest.
inline int longest_axis(const Integer3& a) {
    const Integer3 size = magnitude(a);
    if (size.x < size.y) return size.y < size.z ? 2 : 1;
    return size.x < size.z ? 2 : 0;
}
/// Returns the number of the axis of the least of three magnitudes; of equal ones the first.
template <class Sizes>
int shortest_axis(const Sizes& size) {
    return size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
}
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
ESPALIER_SHARED_OR_PART_OF_CALLER inline Int128 dot<Int128>(const Integer3& a, const Integer3& b) {
    Int128 sum = multiply(a.x, b.x);  // in steps: the temporaries of one expression are all on the stack at once
    sum += multiply(a.y, b.y);
    sum += multiply(a.z, b.z);
    return sum;
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
    Int128 sum = multiply(a.x, b.x);
    sum += multiply(a.y, b.y);
    sum += multiply(a.z, b.z);
    return sum;
}

/// Returns the product in the numbers of that vector, 64 bits or 128, which it must fit.
template <class Vector>
Vector cross_in(const Integer3& a, const Integer3& b) {
    if constexpr (std::is_same_v<Vector, WideVector>) return wide_cross(a, b);
    else return cross(a, b);
}
inline std::int64_t dot(const Integer3& a, const Integer3& b) { return dot<std::int64_t>(a, b); }

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator*(const Vec3& a, float by) { return {a.x * by, a.y * by, a.z * by}; }
constexpr float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float sum_of_magnitudes(const Vec3& a) { return absolute(a.x) + absolute(a.y) + absolute(a.z); }
inline float largest(const Vec3& a) { return maximum(maximum(absolute(a.x), absolute(a.y)), absolute(a.z)); }
inline Vec3 to_vector(const Integer3& a) { return {to_float(a.x), to_float(a.y), to_float(a.z)}; }
inline Vec3 to_vector(const WideVector& a) { return {to_float(a.x), to_float(a.y), to_float(a.z)}; }
inline Vec3 to_vector(const std::int32_t* a) {
    return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

inline Vec3 to_unit(const Vec3& v) {
    const float length = square_root(dot(v, v));
    return {v.x / length, v.y / length, v.z / length};
}
/// The scale keeps squares of the coordinates from overflowing and from vanishing.
inline Vec3 to_unit(const Integer3& a, float scale = 1.0f) { return to_unit(to_vector(a) * scale); }

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
/// Returns what a triangle of the lattice or of a grid takes up along an axis.
template <class Triangle>
inline auto span_of(const Triangle& triangle, int axis) {
    return span_of(triangle.corner[0][axis], triangle.corner[1][axis], triangle.corner[2][axis]);
}

/// Computes a point of the triangle in lattice steps from the weights of corners b and c.
ESPALIER_SHARED_CODE inline Vec3 point_of(const LatticeTriangle& triangle, float u, float v) {
    const auto& corner = triangle.corner;
    float point[3];
    for (int k = 0; k < 3; ++k) {
        const float ab = static_cast<float>(corner[1][k] - corner[0][k]);
        const float ac = static_cast<float>(corner[2][k] - corner[0][k]);
        point[k] = static_cast<float>(corner[0][k]) + (u * ab + v * ac);
    }
    return {point[0], point[1], point[2]};
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
/// Returns the unit normal on the front of the triangle, its coordinates within 4 ulp of 1; zero if it has no area.
ESPALIER_SHARED_CODE inline Vec3 face_normal_of(const LatticeTriangle& triangle) {
    const Integer3 normal = normal_of(integer_triangle(triangle));
    return is_zero(normal) ? Vec3{} : to_unit(normal);
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

/// Returns whether the origin of `triangle` lies behind the triangle's plane. The product of the normal with corner a
/// must fit 128 bits.
ESPALIER_SHARED_CODE inline bool is_origin_behind(const OriginRelative& triangle) {
    return Int128(0) < dot<Int128>(cross(triangle.ab, triangle.ac), triangle.a);
}

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
