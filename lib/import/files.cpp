#include <espalier/import.hpp>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include <import/base/error.hpp>
#include <import/base/gzip.hpp>
#include <import/base/importers.hpp>
#include <import/base/placement.hpp>
#include <import/base/text_file.hpp>
#include <import/files.hpp>
#include <import/format.hpp>
#include <import/guards/limit_guard.hpp>
#include <import/platform/files.hpp>

namespace espalier::importer {

namespace {

void require_readable(const std::string& path) {
    if (path == "-") {
        throw_error(ImportStatus::invalid_options, "-: a mesh needs the name of a file, by whose ending it is read.");
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
        throw_file_error(ImportStatus::invalid_input, path, " is empty. Export it again.");
    }
    if (reason != nullptr) fail_to_read(path, reason);
}

using Import = void(const std::string& path, const ImportOptions& options, ImportResult& imported);

Import* importer_of(MeshFormat format) {
    constexpr Import* importers[] = {import_obj, import_off,         import_ply, import_stl,
                                     import_raw, import_with_assimp, import_3mf};  // glTF that is none was refused
    return importers[static_cast<std::size_t>(format)];
}

/// Throws ImportError (unsupported) for readers that do not keep the vertices of a file. In STL and RAW each triangle
/// has three of its own, and assimp joins and sorts those of the other formats.
void require_kept_vertices(std::optional<MeshFormat> format, const std::string& path) {
    if (format && *format != MeshFormat::stl && *format != MeshFormat::raw) return;
    throw_file_error(ImportStatus::unsupported, path,
                     " is read without the order of its vertices, by which poses of a ",
                     "deformable mesh match. Export it as OBJ, OFF, PLY, 3MF or glTF.");
}

/// Returns the size of a file, and for one that gzip packed the size of its content.
std::uint64_t content_size(const std::string& path) {
    InputFile file(path_of(path));
    std::array<char, 3> mark{};
    file.read(std::as_writable_bytes(std::span(mark)));
    return is_gzip({mark.data(), mark.size()}) ? read_bytes(path).size() : file.size();
}

/// The format that the name's ending states. Nothing: a format of assimp, or OBJ by its first lines.
std::optional<MeshFormat> format_of_name(const std::string& path, std::string_view begin, std::uint64_t size) {
    const std::string ending = ending_of(path);
    const auto named = format_named(std::string_view(ending).substr(ending.empty() ? 0 : 1));
    if (named) refuse_wrong_ending(path, begin, size, *named);
    if (!named && looks_like_obj(begin, size)) return MeshFormat::obj;
    return named;
}

/// What --format names decides, else the content where it declares a format, else the name.
void import_file(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    const std::string begin = read_begin(path, format_begin_bytes);
    refuse_other_than_mesh(path, begin);
    const bool is_stated = !options.format.empty();
    const std::uint64_t size = begin.size() < format_begin_bytes ? begin.size() : content_size(path);
    const auto declared = is_stated ? format_named(options.format) : format_of_content(begin, size);
    const auto format = is_stated || declared ? declared : format_of_name(path, begin, size);
    // JSON is glTF by what is in it, and may be another format.
    const bool may_be_gltf = declared ? declared == MeshFormat::gltf : !is_stated;
    if (may_be_gltf && import_gltf(path, options, imported)) return;
    if (options.keep_vertices) require_kept_vertices(format, path);
    Import* const import = format ? importer_of(*format) : import_with_assimp;
    import(path, options, imported);
}

/// The error as one about this file, for scripts.
[[noreturn]] void rethrow_with_file(const ImportError& error, const std::string& path) {
    ImportErrorDetails details = error.details();
    if (details.file.empty()) details.file = path;
    throw ImportError(error.status(), error.what(), std::move(details));
}

void import_within_limits(const std::string& path, const ImportOptions& options, ImportResult& imported) {
    const bool is_guarded = options.limits.memory != 0 || options.limits.seconds > 0.0 || options.last_words;
    std::optional<LimitGuard> guard;
    if (is_guarded) guard.emplace(path, options);
    try {
        import_file(path, options, imported);
    } catch (const ImportError& error) {
        if (guard && guard->memory_ran_out()) guard->refuse_memory();
        rethrow_with_file(error, path);
    } catch (const std::bad_alloc&) {
        if (!guard) throw;
        guard->refuse_memory();
    }
    if (guard && guard->memory_ran_out()) guard->refuse_memory();
}

void warn_about_up_axis(ImportedFile& file, const ImportOptions& options) {
    if (!file.stated_up || options.up) return;
    const std::string axis = axis_name(*file.stated_up);
    add_warning(file, "up_axis_kept",
                text(printable(file.path), " states that ", axis, " is up, and its axes were kept; --up ",
                     axis == "+X" ? "x" : "z", " turns ", axis, " to +Y."));
}

}  // namespace

void import_files(std::span<const std::string> paths, const ImportOptions& options, ImportResult& imported,
                  const std::function<void(const std::string& path)>& begin) {
    if (!std::isfinite(options.scale) || options.scale <= 0.0)
        throw_error(ImportStatus::invalid_options, "the scale ", options.scale, " is no finite number above zero.");
    for (const std::string& path : paths) {
        if (begin) begin(path);
        require_readable(path);
        import_within_limits(path, options, imported);
        ImportedFile& file = imported.files.back();
        warn_about_up_axis(file, options);
        for (const ImportDiagnostic& warning : file.warnings)
            if (options.warn) options.warn(warning);
    }
    if (!options.materials)
        for (ImportedMesh& mesh : imported.meshes) mesh.materials.clear();
}

void import_or_refuse(ImportResult& imported, const std::function<void()>& import) {
    const auto refuse = [&imported](ImportStatus status, ImportDiagnostic reason) {
        imported.meshes.clear();
        imported.places.clear();
        imported.status = status;
        imported.reason = std::move(reason);
    };
    try {
        import();
        imported.status = ImportStatus::ok;
    } catch (const ImportError& error) {
        refuse(error.status(), error.reason());
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        refuse(ImportStatus::internal,
               {"", text("internal error: ", error.what(), ". Please report how it came about.")});
    }
}

}  // namespace espalier::importer

namespace espalier {

namespace {

std::string_view name_at(const std::vector<std::string>& names, std::uint64_t number) {
    return number < names.size() ? std::string_view(names[number]) : std::string_view();
}

}  // namespace

std::string_view ImportResult::material_name(std::uint32_t material) const {
    std::uint64_t number = material;
    for (const ImportedFile& file : files) {
        if (number < file.materials) return name_at(file.material_names, number);
        number -= file.materials;
    }
    return {};
}

std::string_view ImportResult::mesh_name(const OriginalTriangle& source) const {
    return source.file < files.size() ? name_at(files[source.file].mesh_names, source.mesh) : std::string_view();
}

std::string_view ImportResult::mesh_path(const OriginalTriangle& source) const {
    return source.file < files.size() ? name_at(files[source.file].mesh_paths, source.mesh) : std::string_view();
}

std::vector<MeshView> ImportResult::views() const {
    std::vector<MeshView> result;
    result.reserve(meshes.size());
    for (const ImportedMesh& mesh : meshes) {
        result.push_back({{}, mesh.triangles, mesh.materials, mesh.file, mesh.mesh, mesh.name, mesh.positions});
    }
    return result;
}

ImportResult import_meshes(std::span<const std::string> paths, const ImportOptions& options) {
    ImportResult imported;
    importer::import_or_refuse(imported, [&] {
        if (options.separate_process) importer::import_in_child(paths, options, imported);
        else importer::import_files(paths, options, imported);
    });
    return imported;
}

}  // namespace espalier
