// What an importer returns: triangles in the asset's units and axes, or the places that lead there, and a record of
// each file; and the importers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/bake.hpp>

#include <import/base/error.hpp>
#include <import/base/placement.hpp>

namespace espalier::importer {

/// What reading one file may take: a broken file makes importers reserve memory and read on without bound.
struct ImportLimits {
    std::uint64_t memory = 0;  ///< bytes of address space that are added; 0: unlimited
    double seconds = 0.0;      ///< of processor time; 0: unlimited
};

/// What a process that must end at once leaves behind. Made beforehand: a handler may neither allocate nor lock.
struct LastWords {
    int exit_status = 1;
    std::string to_stderr;
    std::string to_stdout;
};

struct ImportOptions {
    /// The format of the files, or the ending that files of it have, in lower case and without a dot. Empty: content
    /// and name decide.
    std::string format;
    /// One unit of the files in metres. Without it: the unit that a file states, else a metre.
    std::optional<double> metres_per_unit;
    double scale = 1.0;
    /// The axis that points up in the files; it is turned to +Y. Without it the axes stay as they are.
    std::optional<Axis> up;
    bool materials = false;  ///< keep the numbers of materials, and warn of what changes them
    /// Keeps a mesh that a file places several times once, where its own space has it, and lists its places. Without it
    /// each place has a mesh of its own, in the asset's units and axes.
    bool keep_places = false;
    /// Keeps all vertices in the order of the file, those without a triangle too, so that poses of one mesh have the
    /// same positions. An OBJ file is one mesh then. Refuses formats whose order of vertices is not that of their
    /// files.
    bool keep_vertices = false;
    /// Refuses a face that names a vertex which its file does not have. Without it, such a face is warned of and its
    /// triangles stay, for the baker to drop.
    bool require_vertices = false;
    /// Called now and then with what is read and how much of it is done, 0..1.
    std::function<void(const char* stage, double done)> progress;
    /// Calls it, if it is not empty, with so much of all that is read.
    void show_reading(double done, double all) const {
        if (progress) progress("reading", done / all);
    }
    /// Called with each warning about a file when the file is read; not called when empty.
    std::function<void(const ImportWarning& warning)> warn;
    /// Called with what an importer reports for people who look for a fault; not called when empty.
    std::function<void(const std::string& line)> log;
    ImportLimits limits;
    /// Returns how the process ends when a crash or the limit of time ends it while a file is read. Empty: with the
    /// message of the error.
    std::function<LastWords(const ImportError& error)> last_words;
};

/// One mesh at one place of the scene: a mesh that is placed twice is there twice. With ImportOptions::keep_places a
/// mesh in its own space, with the numbers of its first place.
struct ImportedMesh {
    std::vector<Vec3> positions;
    std::vector<TriangleVertices> triangles;
    std::vector<std::uint32_t> materials;  ///< one per triangle if the options keep them; no two files share a number
    std::uint32_t file = 0;
    std::uint32_t mesh = 0;
    std::string name;  ///< "level.obj, mesh 3 (walls)"
};

/// A place of a mesh, with ImportOptions::keep_places.
struct ImportedPlace {
    std::uint32_t mesh = 0;  ///< index into Imported::meshes
    std::uint32_t file = 0;
    std::uint32_t number = 0;  ///< of the mesh at this place, in its file: each place has its own
    Placement placement;       ///< from the mesh's own space to the asset's units and axes
};

/// What was found in one file.
struct ImportedFile {
    std::string path;
    std::vector<std::string> opened;  ///< the file itself and what it refers to that was there: .mtl, .bin
    std::string format;
    std::uint32_t meshes = 0;
    std::vector<std::string> mesh_names;  ///< in the order of their numbers; empty where the file has none
    std::uint64_t triangles = 0;
    std::uint64_t materials = 0;
    std::uint64_t points_and_lines = 0;  ///< skipped: they have no surface
    double metres_per_unit = 1.0;
    std::string unit_origin;              ///< where it is stated: "--unit", "FBX unit scale factor 1", "not stated"
    std::optional<Axis> stated_up;        ///< stated by the file and not carried out by its importer
    std::vector<ImportWarning> warnings;  ///< where the triangles may differ from what the file contains

    /// Appends a warning about the file, or about a mesh of it.
    void warn(const char* kind, std::string message, std::optional<std::uint32_t> number = {}) {
        warnings.push_back({kind, std::move(message), path, number});
    }
};

struct Imported {
    std::vector<ImportedMesh> meshes;
    std::vector<ImportedPlace> places;  ///< of all meshes, in the order of their numbers; empty unless they are kept
    std::vector<ImportedFile> files;

    [[nodiscard]] std::vector<MeshView> views() const;
};

/// Returns the name of a mesh in messages: "level.obj, mesh 3 (walls)". `name` comes from the file, or is empty.
std::string words_for_mesh(const ImportedFile& file, std::uint32_t number, std::string_view name);

/// Wavefront OBJ: the geometry, that is v, f, o, g, and the materials of faces. A mesh is what has the same `o` and `g`
/// names; meshes are numbered by their first face, and triangles by the order of their faces. With
/// ImportOptions::keep_vertices all is one mesh, named if the file names one.
void import_obj(const std::string& path, const ImportOptions& options, Imported& imported);

/// OFF as text, with whatever else its vertices have (COFF, NOFF, STOFF): one mesh. A face's colour ends
/// with its line.
void import_off(const std::string& path, const ImportOptions& options, Imported& imported);

/// PLY, as text and binary in both byte orders: the elements vertex, face and tristrips.
void import_ply(const std::string& path, const ImportOptions& options, Imported& imported);

/// STL, binary and as text: each solid that has triangles is a mesh.
void import_stl(const std::string& path, const ImportOptions& options, Imported& imported);

/// RAW, a text with the coordinates of three corners in each line: one mesh for each group. Textures are skipped. A
/// line has nine numbers, or twelve, of which the first three are a colour, and after them the name of a texture or
/// nothing. Throws ImportError (invalid_input) for other lines, with their number.
void import_raw(const std::string& path, const ImportOptions& options, Imported& imported);

/// glTF 2.0, .gltf and .glb, and b3dm, which contains it; docs/baking.md lists what is read. Returns false for a file
/// that is neither by its content, its ending and the options.
bool import_gltf(const std::string& path, const ImportOptions& options, Imported& imported);

/// 3MF: each object with triangles is a mesh at each place where the build has it, in the unit that the file states.
void import_3mf(const std::string& path, const ImportOptions& options, Imported& imported);

/// Files of the formats that assimp reads.
void import_with_assimp(const std::string& path, const ImportOptions& options, Imported& imported);

}  // namespace espalier::importer
