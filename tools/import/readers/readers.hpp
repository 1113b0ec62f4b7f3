// The formats that are read without a library, one file each. All functions append what they read to `imported`.
#pragma once

#include <string>

#include "import/base/imported.hpp"

namespace espalier::tools {

/// Wavefront OBJ: the geometry, that is v, f, o, g, and the materials of faces. A mesh is what has the same `o` and `g`
/// names; meshes are numbered by their first face, and triangles by the order of their faces. With
/// ImportOptions::keep_vertices all is one mesh, named if the file names one. Throws CommandError as import_files does.
void import_obj(const std::string& path, const ImportOptions& options, Imported& imported);

/// PLY, as text and binary in both byte orders: the elements vertex, face and tristrips. Throws CommandError as
/// import_files does.
void import_ply(const std::string& path, const ImportOptions& options, Imported& imported);

/// STL, binary and as text: each solid that has triangles is a mesh.
/// Throws CommandError as import_files does.
void import_stl(const std::string& path, const ImportOptions& options, Imported& imported);

/// RAW, a text with the coordinates of three corners in each line: one mesh for each group. Textures are skipped. A
/// line has nine numbers, or twelve, of which the first three are a colour, and after them the name of a texture or
/// nothing. Throws CommandError (invalid_input) for other lines, with their number.
void import_raw(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
