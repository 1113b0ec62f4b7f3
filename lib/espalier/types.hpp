// Plain values that queries take and return.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace espalier {

/// The largest distance and the largest ray parameter: no limit.
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// A point or a direction, in the units and axes of the baked mesh.
struct Vec3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// A place in the units and axes of the source, which float32 would round too coarsely far from 0.
struct Vec3d {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    friend constexpr bool operator==(const Vec3d&, const Vec3d&) = default;
};

/// The index of a triangle in its blob: 0 .. Blob::triangle_count() - 1, in baked order. The default is no triangle.
/// original_triangle() maps it to the source mesh.
struct TriangleId {
    std::uint32_t index = 0xFFFFFFFFu;
    friend constexpr auto operator<=>(const TriangleId&, const TriangleId&) = default;
};

/// The id that belongs to no triangle: a miss has it.
inline constexpr TriangleId no_triangle = {};

/// Three corners, counter-clockwise seen from the front: a shape, and the baked corners of a triangle.
struct Triangle {
    Vec3 a;
    Vec3 b;
    Vec3 c;
};

/// The part of a triangle that a point lies on, and the smallest of several: a corner, else an edge, else the face.
enum class Feature : std::uint8_t { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

/// A side of a triangle. The corners run counter-clockwise when seen from the front.
enum class Side : std::uint8_t { front, back };

/// Selects the faces that a query ignores: triangles that show their back, or their front.
enum class FaceCulling : std::uint8_t { none, back, front };

/// The error that an approximate query may make, as a distance in the blob's units (approximate.hpp).
struct Accuracy {
    float distance = 0.0f;
};

/// The source of a triangle: the input file, the mesh in that file and the triangle of that mesh, counted from 0.
///
/// The blob's corners a, b, c are the source's corners first_corner, first_corner + 1 and first_corner + 2, modulo 3,
/// in the same winding. In profile fast first_corner is always 0.
struct OriginalTriangle {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    std::uint32_t first_corner = 0;  ///< 0, 1 or 2
    friend constexpr bool operator==(const OriginalTriangle&, const OriginalTriangle&) = default;
};

}  // namespace espalier
