// Meshes that the tests read where they are installed. A claim that needs one that is absent says that it is skipped.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mesh.hpp"

namespace espalier::tests {

/// OBJ (v and f lines; polygons as fans) or PLY (binary, little-endian, float positions, uchar-int faces), by the
/// file's ending. Throws std::runtime_error that names the file.
Mesh read_mesh(const std::filesystem::path& file);

/// All .obj and .ply files of the folder in the environment's ESPALIER_MESHES or the build's, in order of name.
std::vector<std::filesystem::path> mesh_files();

/// The file of that name in the same folder, if it is there.
std::optional<std::filesystem::path> mesh_file(const char* name);

}  // namespace espalier::tests
