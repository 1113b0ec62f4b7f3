// The places of a source's meshes: what a blob or a scene is compared with.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <espalier/import.hpp>

namespace espalier::tools {

/// Returns the places of the meshes; without a list of them each mesh is in place.
std::vector<ImportedPlace> places_of(const ImportResult& source);

/// Returns "level.obj, mesh 3 (walls)".
std::string name_of_place(const ImportResult& source, const ImportedPlace& place);

using SourceCorners = std::array<Vec3d, 3>;

/// Returns the corners of a triangle in the mesh's own space; nothing where one is missing or not finite.
std::optional<SourceCorners> corners_of(const ImportedMesh& mesh, std::uint64_t triangle);

/// Returns corners at a place, in the winding that the bake gives them: a place that mirrors turns it around.
SourceCorners corners_at(const ImportedPlace& place, const SourceCorners& corners);

/// Returns whether each corner is within `tolerance` of its counterpart, whichever corner is the first.
bool are_corners_near(const SourceCorners& a, const SourceCorners& b, double tolerance);
Vec3d middle_of(const SourceCorners& corners);

}  // namespace espalier::tools
