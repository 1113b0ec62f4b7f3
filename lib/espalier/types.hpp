// The plain values that queries take and return.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>

namespace espalier {

/// The largest distance and the largest ray parameter: it means "no limit".
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// A point or a direction, in the units and axes of the baked mesh.
struct Vec3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// A point in the units and axes of the source, in double because float32 is too coarse far from the origin.
struct Vec3d {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    friend constexpr bool operator==(const Vec3d&, const Vec3d&) = default;
};

/// The index of a triangle in its blob, from 0 to Blob::triangle_count() - 1. Baking reorders triangles:
/// original_triangle() maps an index back to the source mesh. A default TriangleId names no triangle.
struct TriangleId {
    std::uint32_t index = 0xFFFFFFFFu;
    friend constexpr auto operator<=>(const TriangleId&, const TriangleId&) = default;
};

/// The id that a miss returns; it belongs to no triangle.
inline constexpr TriangleId no_triangle = {};

/// Three corners, counter-clockwise as seen from the front. Serves as a query shape and as the corners of a baked
/// triangle.
struct Triangle {
    Vec3 a;
    Vec3 b;
    Vec3 c;
};

/// The part of a triangle that a point lies on. A point that lies on several is given the smallest: a corner before an
/// edge, an edge before the face.
enum class Feature : std::uint8_t { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

/// A side of a triangle, whose corners run counter-clockwise as seen from the front.
enum class Side : std::uint8_t { front, back };

/// Which triangles a query ignores: none, those that show it their back, or those that show it their front.
enum class FaceCulling : std::uint8_t { none, back, front };

/// The error that an approximate query may make, as a distance in the blob's units (see approximate.hpp).
struct Accuracy {
    float distance = 0.0f;
};

/// Identifies a source triangle by its input file, the mesh in that file and the triangle in that mesh, all counted
/// from 0.
///
/// The baker may rotate the corners of a triangle but keeps its winding: corners a, b and c of the blob are corners
/// first_corner, first_corner + 1 and first_corner + 2 (modulo 3) of the source. In profile fast, first_corner is
/// always 0.
struct OriginalTriangle {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    std::uint32_t first_corner = 0;  ///< 0, 1 or 2
    friend constexpr bool operator==(const OriginalTriangle&, const OriginalTriangle&) = default;
};

}  // namespace espalier
