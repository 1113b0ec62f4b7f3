// The importers, each of which appends the meshes of one file, and what they tell on the way.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <espalier/import.hpp>

#include <import/base/error.hpp>
#include <import/base/placement.hpp>

namespace espalier::importer {

/// Calls ImportOptions::progress, if it is not empty, with so much of all that is read.
inline void show_reading(const ImportOptions& options, double done, double all) {
    if (options.progress) options.progress("reading", done / all);
}

/// Appends a warning about the file, or about a mesh of it.
inline void add_warning(ImportedFile& file, const char* kind, std::string message,
                        std::optional<std::uint32_t> number = {}) {
    file.warnings.push_back({kind, std::move(message), file.path, number});
}

/// Returns the name of a mesh in messages: "level.obj, mesh 3 (walls)". `name` comes from the file, or is empty.
std::string words_for_mesh(const ImportedFile& file, std::uint32_t number, std::string_view name);

/// Wavefront OBJ: the geometry, that is v, f, o, g, and the materials of faces. A mesh is what has the same `o` and `g`
/// names; meshes are numbered by their first face, and triangles by the order of their faces. With
/// ImportOptions::keep_vertices all is one mesh, named if the file names one.
void import_obj(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// OFF as text, with whatever else its vertices have (COFF, NOFF, STOFF): one mesh. A face's colour ends
/// with its line.
void import_off(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// PLY, as text and binary in both byte orders: the elements vertex, face and tristrips.
void import_ply(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// STL, binary and as text: each solid that has triangles is a mesh.
void import_stl(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// RAW, a text with the coordinates of three corners in each line: one mesh for each group. Textures are skipped. A
/// line has nine numbers, or twelve, of which the first three are a colour, and after them the name of a texture or
/// nothing. Throws ImportError (invalid_input) for other lines, with their number.
void import_raw(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// glTF 2.0, .gltf and .glb, and b3dm, which contains it; docs/baking.md lists what is read. Returns false for a file
/// that is neither by its content, its ending and the options.
bool import_gltf(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// 3MF: each object with triangles is a mesh at each place where the build has it, in the unit that the file states.
void import_3mf(const std::string& path, const ImportOptions& options, ImportResult& imported);

/// Files of the formats that assimp reads.
void import_with_assimp(const std::string& path, const ImportOptions& options, ImportResult& imported);

}  // namespace espalier::importer
