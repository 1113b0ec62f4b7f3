// Importing: reads mesh files into the triangles that bake() takes, in the asset's units and axes. This is offline
// code: it allocates and may throw std::bad_alloc.
//
// Any number of threads may call import_meshes() at once, with one exception: what ImportOptions::limits and last_words
// set applies to the whole process, so no other thread may import meanwhile unless separate_process is set.
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
    /// Returns whether the transform mirrors, so that the corners of each triangle must be taken in the opposite order.
    [[nodiscard]] bool mirrors() const;
    [[nodiscard]] double determinant() const;
};

/// A warning about a file, or the reason why there are no meshes.
struct ImportDiagnostic {
    std::string kind;       ///< one lower-case word, or several joined by '_', for programs; may be empty for a reason
    std::string message;    ///< whole sentences that say what was found, where, and what to do
    std::string file = {};  ///< empty if it concerns no file
    std::optional<std::uint32_t> mesh = {};
    std::optional<std::uint64_t> triangle = {};
};

/// The outcome of an import: ok, or why nothing was imported.
enum class ImportStatus : std::uint8_t {
    ok,
    invalid_options,  ///< an option is out of range, or names a format that does not exist
    file_access,      ///< a file cannot be read
    invalid_input,    ///< a file was read but its content is broken
    unsupported,      ///< valid, but beyond what this version, this build or the format of blobs can do
    internal,         ///< a bug in the importers
};

/// Limits on reading one file, because a broken file can make importers allocate and read without bound.
struct ImportLimits {
    std::uint64_t memory = 0;  ///< bytes of additional address space; 0: unlimited
    double seconds = 0.0;      ///< seconds of processor time; 0: unlimited
};

/// What a process that must end at once leaves behind. It is prepared in advance, because a signal handler may neither
/// allocate nor lock.
struct LastWords {
    int exit_status = 1;
    std::string to_stderr;
    std::string to_stdout;
};

/// The options of import_meshes().
struct ImportOptions {
    /// The format of the files, or the extension of files in that format, in lower case and without a dot. If empty,
    /// content and name decide.
    std::string format = {};
    /// The length of a unit of the files, in metres. If not set, it is the unit that the file states, or else a metre.
    std::optional<double> metres_per_unit = std::nullopt;
    double scale = 1.0;  ///< factor on all coordinates; finite and above 0
    /// The axis that points up in the files, which is turned to +Y. If not set, the axes stay as they are.
    std::optional<Axis> up = std::nullopt;
    bool materials = false;  ///< keeps material numbers, and warns of what changes them
    /// Keeps a mesh that a file places several times only once, in its own space, and lists its places. Without this
    /// option, each place has a mesh of its own, in the asset's units and axes.
    bool keep_places = false;
    /// Keeps all vertices in the order of the file, even those without a triangle, so that poses of one mesh have the
    /// same positions. An OBJ file is then a single mesh. Refuses formats whose vertex order is not that of their
    /// files.
    bool keep_vertices = false;
    /// Refuses a face that names a vertex which its file does not have or, in text formats, one that is NaN or
    /// infinite. Without this option, the former causes a warning, and both kinds of triangles stay for the baker to
    /// drop.
    bool require_vertices = false;
    /// Called from time to time with what is being read and the completed fraction, 0..1. May be empty.
    std::function<void(const char* stage, double done)> progress = nullptr;
    /// Called with each warning about a file when the file is read. May be empty.
    std::function<void(const ImportDiagnostic& warning)> warn = nullptr;
    /// Called with what an importer logs for people who look for a fault. May be empty.
    std::function<void(const std::string& line)> log = nullptr;

    /// Reads in a child process, which is created by fork() and returns the meshes through a pipe. If a library that
    /// reads a format crashes there or reaches a limit, the import is refused and this process continues. Costs the
    /// time to copy the meshes. Refused where the system has no fork(), as on Windows. The functions above are called
    /// in this process.
    bool separate_process = false;
    /// Limits on the process that reads. Without separate_process that is this process: all its threads share the
    /// remaining memory, and running out of time ends it.
    ImportLimits limits = {};
    /// For a process that does little but import. Called before a file is read, with the reason that a crash or the
    /// time limit would have; returns how the process then ends. If empty, crashes are not handled, and running out of
    /// time prints the message of the reason. Not called with separate_process.
    std::function<LastWords(const ImportDiagnostic& reason)> last_words = nullptr;
};

/// Returns the memory limit that suits most machines: half of the memory, since baking takes more than importing.
/// Returns 0, for no limit, on systems of this kind that have none, and nothing if the memory of the machine is
/// unknown.
std::optional<std::uint64_t> default_import_memory();

/// One mesh at one place of the scene, so a mesh that is placed twice appears twice. With ImportOptions::keep_places,
/// it is a mesh in its own space, with the numbers of its first place.
struct ImportedMesh {
    std::vector<Vec3d> positions;  ///< as in the file, or where its transforms, unit and axes put them
    std::vector<TriangleVertices> triangles;
    std::vector<std::uint32_t> materials;  ///< one per triangle if the options keep them; files share no number
    std::uint32_t file = 0;                ///< index into ImportResult::files
    std::uint32_t mesh = 0;                ///< its index in the file
    std::string name;                      ///< for messages: "level.obj, mesh 3 (walls)"
};

/// A place of a mesh, with ImportOptions::keep_places.
struct ImportedPlace {
    std::uint32_t mesh = 0;  ///< index into ImportResult::meshes
    std::uint32_t file = 0;
    std::uint32_t number = 0;  ///< number of the mesh at this place in its file; each place has its own
    Placement placement;       ///< from the mesh's own space to the asset's units and axes
};

/// What was found in one file.
struct ImportedFile {
    std::string path;
    std::vector<std::string> opened;  ///< the file itself and those it refers to that exist: .mtl, .bin
    std::string format;
    std::uint32_t meshes = 0;
    /// In the order of the meshes' numbers; empty where the file has no name. This and the next two are UTF-8, with
    /// U+FFFD in place of each byte of the file that is not valid. Everything else, including control characters, is as
    /// in the file.
    std::vector<std::string> mesh_names;
    /// The names of the nodes that lead to each mesh, joined by '/', such as "Walls/Door_02". Nodes without a name are
    /// left out, and of more than 1,000 bytes only the last are kept. Empty for formats without nodes, and once all of
    /// them take 256 MiB.
    std::vector<std::string> mesh_paths;
    std::uint64_t triangles = 0;
    std::uint64_t materials = 0;              ///< how many material numbers the file has
    std::vector<std::string> material_names;  ///< by number minus those of the files before; empty if without a name
    std::uint64_t points_and_lines = 0;       ///< skipped, because they have no surface
    double metres_per_unit = 1.0;
    std::string unit_origin;        ///< what states it, such as "--unit", "FBX unit scale factor 1" or "not stated"
    std::optional<Axis> stated_up;  ///< stated by the file but not applied by its importer
    std::vector<ImportDiagnostic> warnings;  ///< where the triangles may differ from the content of the file
};

/// The meshes, or the reason why there are none. Converts to true if the files were read.
struct [[nodiscard]] ImportResult {
    std::vector<ImportedMesh> meshes;   ///< empty unless status is ok, like `places`
    std::vector<ImportedPlace> places;  ///< of all meshes, in the order of their numbers; empty unless kept
    std::vector<ImportedFile> files;    ///< in the order of the paths; after a refusal, those read before it
    ImportStatus status = ImportStatus::internal;
    ImportDiagnostic reason;  ///< why nothing was imported; empty if status is ok

    /// Returns the views that bake() takes. The result must outlive them.
    [[nodiscard]] std::vector<MeshView> views() const;

    /// Return the name that the file gives to a material, by the number that blobs store, or to the mesh of a
    /// triangle's source: its own name, or those of the nodes that lead to it. Empty where the file has no name or
    /// nothing has the number. Valid as long as `files`. O(files).
    [[nodiscard]] std::string_view material_name(std::uint32_t material) const;
    [[nodiscard]] std::string_view mesh_name(const OriginalTriangle& source) const;
    [[nodiscard]] std::string_view mesh_path(const OriginalTriangle& source) const;

    explicit operator bool() const noexcept { return status == ImportStatus::ok; }
};

/// Reads the files in this order: glTF 2.0, 3MF, OBJ, OFF, PLY, STL, RAW, and the formats that the library assimp
/// reads. Nothing in them is trusted: anything that differs from what a file states causes a warning, or is refused
/// with its place.
ImportResult import_meshes(std::span<const std::string> paths, const ImportOptions& options = {});

}  // namespace espalier
