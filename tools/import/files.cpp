#include "files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <string_view>
#include <utility>

#include "base/exit_code.hpp"
#include "import/base/text_file.hpp"
#include "import/guards/limit_guard.hpp"
#include "platform/files.hpp"

namespace espalier::tools {

namespace {

void require_readable(const std::string& path) {
    if (path == "-") {
        throw_error(ExitCode::usage, "-: a mesh needs the name of a file, by whose ending it is read.");
    }
    std::error_code error;
    const auto status = std::filesystem::status(path_of(path), error);
    const char* reason = nullptr;
    if (!std::filesystem::exists(status)) {
        reason = std::strerror(error ? error.value() : ENOENT);
    } else if (std::filesystem::is_directory(status)) {
        reason = "it is a folder";
    } else if (!std::filesystem::is_regular_file(status)) {
        reason = "importers read files only, no pipes or devices";
    } else if (const InputFile file(path_of(path)); file.error() != 0) {
        reason = std::strerror(file.error());
    } else if (file.size() == 0) {
        throw_file_error(ExitCode::invalid_input, path, " is empty. Export it again.");
    }
    if (reason != nullptr) fail_to_read(path, reason);
}

using Import = void(const std::string& path, const ImportOptions& options, Imported& imported);

/// Throws CommandError (unsupported) for readers that do not keep the vertices of a file. In STL and RAW each triangle
/// has three of its own, and assimp joins and sorts those of the other formats.
void require_kept_vertices(Import* import, const std::string& path) {
    if (import == import_obj || import == import_ply || import == import_off) return;
    throw_file_error(ExitCode::unsupported, path, " is read without the order of its vertices, by which poses of a ",
                     "deformable mesh match. Export it as OBJ, PLY, OFF or glTF.");
}

/// By the content where it names its format, else by the name's ending. Throws CommandError (unsupported) for a blob.
Import* importer_of(const std::string& path) {
    char begin[5] = {};
    InputFile file(path_of(path));
    file.read(std::as_writable_bytes(std::span(begin)));
    if (file.error() != 0) fail_to_read(path, file.error());
    const std::string_view content(begin, sizeof(begin));
    if (content.starts_with("ESPL") || content.starts_with("ESPS")) {
        throw_file_error(ExitCode::unsupported, path, " is a ", content[3] == 'L' ? "blob" : "scene",
                         " already. Give the mesh that it was baked from.");
    }
    if (content.starts_with("ply\n") || content.starts_with("ply\r")) return import_ply;
    const std::string ending = ending_of(path);
    if (ending == ".obj") return import_obj;
    if (ending == ".off") return import_off;
    if (ending == ".ply") return import_ply;
    if (ending == ".raw") return import_raw;
    if (ending == ".stl" || (ending.empty() && content == "solid")) return import_stl;
    return import_with_assimp;
}

/// The error as one about this file, for scripts.
[[noreturn]] void rethrow_with_file(const CommandError& error, const std::string& path) {
    ErrorDetails details = error.details();
    if (details.file.empty()) details.file = path;
    throw CommandError(error.code(), error.what(), std::move(details));
}

void import_within_limits(const std::string& path, const ImportOptions& options, Imported& imported) {
    const LimitGuard guard(path, options);
    try {
        if (!import_gltf(path, options, imported)) {
            Import* const import = importer_of(path);
            if (options.keep_vertices) require_kept_vertices(import, path);
            import(path, options, imported);
        }
    } catch (const CommandError& error) {
        if (guard.memory_ran_out()) guard.refuse_memory();
        rethrow_with_file(error, path);
    } catch (const std::bad_alloc&) {
        guard.refuse_memory();
    }
    if (guard.memory_ran_out()) guard.refuse_memory();
}

void warn_about_up_axis(ImportedFile& file, const ImportOptions& options) {
    if (!file.stated_up || options.up) return;
    const std::string axis = axis_name(*file.stated_up);
    file.warn("up_axis_kept", text(printable(file.path), " states that ", axis, " is up, and its axes were kept; --up ",
                                   axis == "+X" ? "x" : "z", " turns ", axis, " to +Y."));
}

}  // namespace

std::vector<MeshView> Imported::views() const {
    std::vector<MeshView> result;
    result.reserve(meshes.size());
    for (const ImportedMesh& mesh : meshes) {
        result.push_back({mesh.positions, mesh.triangles, mesh.materials, mesh.file, mesh.mesh, mesh.name});
    }
    return result;
}

Imported import_files(std::span<const std::string> paths, const ImportOptions& options) {
    Imported imported;
    for (const std::string& path : paths) {
        require_readable(path);
        import_within_limits(path, options, imported);
        ImportedFile& file = imported.files.back();
        warn_about_up_axis(file, options);
        for (const Warning& warning : file.warnings)
            if (options.warn) options.warn(warning);
    }
    if (!options.materials)
        for (ImportedMesh& mesh : imported.meshes) mesh.materials.clear();
    return imported;
}

}  // namespace espalier::tools
