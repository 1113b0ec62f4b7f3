// The importers, one for each format or, for those of assimp, one for all. Each appends the meshes of one readable file
// and its record to `imported`, and throws CommandError as import_files does.
#pragma once

#include "imported.hpp"

namespace espalier::tools {

/// Wavefront OBJ: the geometry, that is v, f, o, g, and the materials of faces. A mesh is what has the same `o` and `g`
/// names; meshes are numbered by their first face, and triangles by the order of their faces. With
/// ImportOptions::keep_vertices all is one mesh, named if the file names one.
void import_obj(const std::string& path, const ImportOptions& options, Imported& imported);

/// PLY, as text and binary in both byte orders: the elements vertex, face and tristrips.
void import_ply(const std::string& path, const ImportOptions& options, Imported& imported);

/// STL, binary and as text: each solid that has triangles is a mesh.
void import_stl(const std::string& path, const ImportOptions& options, Imported& imported);

/// RAW, a text with the coordinates of three corners in each line: one mesh for each group. Textures are skipped. A
/// line has nine numbers, or twelve, of which the first three are a colour, and after them the name of a texture or
/// nothing. Throws CommandError (invalid_input) for other lines, with their number.
void import_raw(const std::string& path, const ImportOptions& options, Imported& imported);

/// glTF 2.0, .gltf and .glb, of which docs/baking.md lists what is read. Returns false for a file that is no glTF.
bool import_gltf(const std::string& path, const ImportOptions& options, Imported& imported);

/// Files of the formats that assimp reads.
void import_with_assimp(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::tools
