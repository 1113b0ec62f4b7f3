// Importing: mesh files to the triangles that bake() takes, in the asset's units and axes. This is offline code: it
// allocates, and may throw std::bad_alloc.
//
// Thread safety: any number of threads may call import_meshes at once. What ImportOptions::limits and last_words set
// holds for the whole process, so that no other thread may import meanwhile; with separate_process it may.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/types.hpp>

namespace espalier {

enum class Axis : std::uint8_t { x, y, z };

/// An affine transform: point -> linear * point + offset.
struct Placement {
    std::array<std::array<double, 3>, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows
    std::array<double, 3> offset{};

    /// Rounds in float64 only.
    [[nodiscard]] Vec3d operator()(const Vec3d& point) const;
    /// Turns the inside out, so that the corners of a triangle must be taken the other way round.
    [[nodiscard]] bool mirrors() const;
    [[nodiscard]] double determinant() const;
};

/// A warning about a file, or the reason why there are no meshes.
struct ImportDiagnostic {
    std::string kind;       ///< one lower-case word or several joined by '_', for programs; may be empty for a reason
    std::string message;    ///< whole sentences: what was found, where, and what to do
    std::string file = {};  ///< empty when it is about no file
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
};

/// The result of an import: ok, or why nothing was imported.
enum class ImportStatus : std::uint8_t {
    ok,
    invalid_options,  ///< an option is out of its range, or names a format that does not exist
    file_access,      ///< a file cannot be read
    invalid_input,    ///< a file was read, and its content is broken
    unsupported,      ///< sound, but beyond what this version, this build or the format of blobs can do
    internal,         ///< an error in the importers
};

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

/// The options of import_meshes().
struct ImportOptions {
    /// The format of the files, or the ending that files of it have, in lower case and without a dot. Empty: content
    /// and name decide.
    std::string format = {};
    /// One unit of the files in metres. Without it: the unit that a file states, else a metre.
    std::optional<double> metres_per_unit = std::nullopt;
    double scale = 1.0;  ///< of all coordinates; finite and above 0
    /// The axis that points up in the files; it is turned to +Y. Without it the axes stay as they are.
    std::optional<Axis> up = std::nullopt;
    bool materials = false;  ///< keep the numbers of materials, and warn of what changes them
    /// Keeps a mesh that a file places several times once, where its own space has it, and lists its places. Without it
    /// each place has a mesh of its own, in the asset's units and axes.
    bool keep_places = false;
    /// Keeps all vertices in the order of the file, those without a triangle too, so that poses of one mesh have the
    /// same positions. An OBJ file is one mesh then. Refuses formats whose order of vertices is not that of their
    /// files.
    bool keep_vertices = false;
    /// Refuses a face that names a vertex which its file does not have, and in texts one that is NaN or infinite.
    /// Without it, the former is warned of, and triangles of both stay, for the baker to drop.
    bool require_vertices = false;
    /// Called now and then with what is read and how much of it is done, 0..1. May be empty.
    std::function<void(const char* stage, double done)> progress = nullptr;
    /// Called with each warning about a file when the file is read. May be empty.
    std::function<void(const ImportDiagnostic& warning)> warn = nullptr;
    /// Called with what an importer reports for people who look for a fault. May be empty.
    std::function<void(const std::string& line)> log = nullptr;

    /// Reads in a child process, which fork() makes and a pipe returns the meshes of: where a library crashes that
    /// reads a format, or reaches a limit, that is a refusal, and this process goes on. Takes the time of copying the
    /// meshes. Refused where the system has no fork(), as on Windows. The functions above are called in this process.
    bool separate_process = false;
    /// Limits on the process that reads. Without separate_process that is this one: all its threads share the memory
    /// that is left, and the end of the time ends it.
    ImportLimits limits = {};
    /// For a process that does little else than import. Called before a file is read, with the reason that a crash or
    /// the limit of time would be; returns how the process ends then. Empty: crashes are not handled, and the end of
    /// the time leaves the message of the reason. Not called with separate_process.
    std::function<LastWords(const ImportDiagnostic& reason)> last_words = nullptr;
};

/// Returns the limit of memory that suits most machines: half of what it has, since baking takes more than importing.
/// Returns 0, no limit, where systems of this kind have none, and nothing where the machine's memory is unknown.
std::optional<std::uint64_t> default_import_memory();

/// One mesh at one place of the scene: a mesh that is placed twice is there twice. With ImportOptions::keep_places a
/// mesh in its own space, with the numbers of its first place.
struct ImportedMesh {
    std::vector<Vec3d> positions;  ///< as the file has them, or where its transforms, unit and axes put them
    std::vector<TriangleVertices> triangles;
    std::vector<std::uint32_t> materials;  ///< one per triangle if the options keep them; no two files share a number
    std::uint32_t file = 0;                ///< index into ImportResult::files
    std::uint32_t mesh = 0;                ///< its number in the file
    std::string name;                      ///< for messages: "level.obj, mesh 3 (walls)"
};

/// A place of a mesh, with ImportOptions::keep_places.
struct ImportedPlace {
    std::uint32_t mesh = 0;  ///< index into ImportResult::meshes
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
    /// In the order of their numbers; empty where the file has none. These and the next two are UTF-8: U+FFFD stands
    /// for each byte of the file that is no part of it. All else is as the file has it, control characters too.
    std::vector<std::string> mesh_names;
    /// The names of the nodes that lead to each mesh, joined by '/': "Walls/Door_02". Nodes without a name are left
    /// out, and of more than 1,000 bytes all but the last. Empty for formats without nodes, and once all have 256 MiB.
    std::vector<std::string> mesh_paths;
    std::uint64_t triangles = 0;
    std::uint64_t materials = 0;              ///< how many numbers of materials the file has
    std::vector<std::string> material_names;  ///< by the number less those of the files before; empty without one
    std::uint64_t points_and_lines = 0;       ///< skipped: they have no surface
    double metres_per_unit = 1.0;
    std::string unit_origin;                 ///< what states it: "--unit", "FBX unit scale factor 1", "not stated"
    std::optional<Axis> stated_up;           ///< stated by the file and not carried out by its importer
    std::vector<ImportDiagnostic> warnings;  ///< where the triangles may differ from what the file contains
};

/// The meshes, or the reason why there are none. Converts to true if the files were read.
struct [[nodiscard]] ImportResult {
    std::vector<ImportedMesh> meshes;   ///< empty unless status is ok, as `places`
    std::vector<ImportedPlace> places;  ///< of all meshes, in the order of their numbers; empty unless they are kept
    std::vector<ImportedFile> files;    ///< in the order of the paths; of a refusal those that were read before it
    ImportStatus status = ImportStatus::internal;
    ImportDiagnostic reason;  ///< why nothing was imported; empty if status is ok

    /// Returns what bake() takes. The result must outlive it.
    [[nodiscard]] std::vector<MeshView> views() const;

    /// Return what the file calls a material, by the number that blobs store, and the mesh of a triangle's source: its
    /// name, or the names of the nodes that lead to it. Empty where the file has none, or nothing has the number. Valid
    /// as long as `files`. O(files).
    [[nodiscard]] std::string_view material_name(std::uint32_t material) const;
    [[nodiscard]] std::string_view mesh_name(const OriginalTriangle& source) const;
    [[nodiscard]] std::string_view mesh_path(const OriginalTriangle& source) const;

    explicit operator bool() const noexcept { return status == ImportStatus::ok; }
};

/// Reads the files in this order: glTF 2.0, 3MF, OBJ, OFF, PLY, STL, RAW, and what the library assimp reads. Nothing in
/// them is trusted: what differs from what a file states is warned of, or refused with the place.
ImportResult import_meshes(std::span<const std::string> paths, const ImportOptions& options = {});

}  // namespace espalier
