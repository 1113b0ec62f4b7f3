// The plain values that every query takes and gives.
#pragma once

#include <compare>
#include <cstdint>

namespace espalier {

/// A point or a direction, in the units and axes that the asset was baked in.
struct Vec3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

/// A triangle of a blob, named by its storage index: 0 .. Blob::triangle_count() - 1.
/// The order is the baker's; `original_triangle` leads back to the source when the blob carries ids.
struct Triangle {
    std::uint32_t index = 0;
    friend constexpr auto operator<=>(const Triangle&, const Triangle&) = default;
};

/// What a query answers with where it found none: no blob has as many triangles.
inline constexpr Triangle no_triangle = {0xFFFFFFFFu};

/// The part of a triangle that a point lies on, of several the smallest: a corner, else a side, else the face.
enum class Feature : std::uint8_t { face, edge_ab, edge_bc, edge_ca, vertex_a, vertex_b, vertex_c };

/// The three corners of a triangle, in the winding of its source; which comes first, OriginalTriangle says.
struct Corners {
    Vec3 a;
    Vec3 b;
    Vec3 c;
};

/// Where a triangle came from: which input file, which mesh in it, which triangle of that mesh, all counted from 0.
///
/// The blob's corners a, b, c are the source's corners first_corner, first_corner + 1 and first_corner + 2, modulo 3,
/// in the same winding; in profile fast first_corner is always 0.
struct OriginalTriangle {
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::uint32_t triangle = 0;
    std::uint32_t first_corner = 0;  ///< 0, 1 or 2
    friend constexpr bool operator==(const OriginalTriangle&, const OriginalTriangle&) = default;
};

/// What a visitor answers after each triangle or hit.
enum class Visit : std::uint8_t { keep_going, stop };
inline constexpr Visit keep_going = Visit::keep_going;
inline constexpr Visit stop = Visit::stop;

}  // namespace espalier
