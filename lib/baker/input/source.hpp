// What is left of the input once it is checked: one list of sound triangles over one list of positions.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

namespace espalier::baker {

/// Corners are numbers into Source::positions. The original id counts the triangles of all meshes in a row, broken ones
/// included, so that dropping a triangle renames no other.
struct SourceTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t original_id;
};

struct Source {
    std::span<const MeshView> meshes;
    std::vector<std::uint32_t> first_triangle;  ///< original id of each mesh's first triangle
    std::uint32_t triangle_count = 0;           ///< of all meshes, broken ones included
    Vec3d origin;                               ///< was subtracted from all positions
    double moved = 0.0;                         ///< no position was moved farther by the rounding of that difference
    bool is_float64 = false;                    ///< some position that was given is no float32 number
    std::vector<Vec3d> positions;               ///< of all meshes in a row, from the origin; finite ones fit float32
    std::vector<SourceTriangle> triangles;      ///< finite, in range, with an area; ascending ids
    std::vector<SourceTriangle> without_area;   ///< finite, in range, but a point or a line
    unsigned material_bits = 0;                 ///< that hold all materials: 0 if all are 0, else 8 or 16
};

/// "level.obj, mesh 3 (walls)"
[[nodiscard]] std::string mesh_name(std::span<const MeshView> meshes, std::size_t mesh);

/// "level.obj, mesh 3 (walls), triangle 17"
[[nodiscard]] std::string triangle_name(const Source& source, std::uint32_t original_id);

/// The place of a mesh for errors.
[[nodiscard]] SourcePlace place_of(const MeshView& mesh);

/// The place of a triangle for errors.
[[nodiscard]] SourcePlace place_of(const Source& source, std::uint32_t original_id);

/// A finding of this one triangle.
[[nodiscard]] Finding first_finding(const Source& source, std::uint32_t original_id);

/// Where a triangle came from, beginning with its first corner.
[[nodiscard]] OriginalTriangle original_triangle(const Source& source, std::uint32_t original_id);

/// The material that came with a triangle, 0 without one.
[[nodiscard]] std::uint32_t material_of(const Source& source, std::uint32_t original_id);

}  // namespace espalier::baker
