#include "import_files.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "assimp_importer.hpp"
#include "exit_code.hpp"
#include "gltf_importer.hpp"
#include "numbers.hpp"

namespace espalier::tools {

namespace {

void require_readable(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    const char* reason = nullptr;
    if (!std::filesystem::exists(status)) {
        reason = std::strerror(error ? error.value() : ENOENT);
    } else if (std::filesystem::is_directory(status)) {
        reason = "it is a folder";
    } else if (!std::filesystem::is_regular_file(status)) {
        reason = "importers read files only, no pipes or devices";
    } else if (errno = 0; !std::ifstream(path, std::ios::binary).is_open()) {
        reason = std::strerror(errno);
    }
    if (reason == nullptr) return;
    throw CommandError(ExitCode::file_access,
                       text("cannot read '", printable(path), "': ", reason, ". Check the path and the rights on it."),
                       {.file = path});
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
        if (!import_gltf(path, options, imported)) import_with_assimp(path, options, imported);
    }
    return imported;
}

}  // namespace espalier::tools
