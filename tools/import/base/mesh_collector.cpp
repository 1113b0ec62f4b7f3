#include "mesh_collector.hpp"

#include <utility>

#include <espalier/format.hpp>

#include "base/exit_code.hpp"
#include "base/numbers.hpp"

namespace espalier::tools {

MeshCollector::MeshCollector(const ImportOptions& options, ImportedFile& file, Imported& imported)
    : options_(options), file_(file), imported_(imported) {
    for (const ImportedFile& earlier : imported.files) {
        first_material_ += earlier.materials;
        triangles_before_ += earlier.triangles;
    }
}

Placement MeshCollector::asset_placement() const {
    const Placement asset = scaled_by(options_.scale * file_.metres_per_unit);
    return options_.up ? combine(turned_to_y_up(*options_.up), asset) : asset;
}

void MeshCollector::require_room(std::uint64_t triangles, std::string_view words) const {
    const std::uint64_t earlier = triangles_before_ + file_.triangles;
    if (triangles <= format::max_triangles && earlier + triangles <= format::max_triangles) return;
    throw CommandError(ExitCode::unsupported, text(words, ": with it the files have more than ", format::max_triangles,
                                                   " triangles, the most a blob can hold. Bake them in parts."));
}

ImportedMesh MeshCollector::begin(std::string_view name, std::uint64_t triangles) {
    ImportedMesh mesh;
    mesh.file = static_cast<std::uint32_t>(imported_.files.size());
    mesh.mesh = file_.meshes++;
    file_.mesh_names.emplace_back(name);
    mesh.name = text(printable(file_.path), ", mesh ", mesh.mesh);
    if (!name.empty()) mesh.name += text(" (", printable(name), ")");
    require_room(triangles, mesh.name);
    return mesh;
}

void MeshCollector::add(ImportedMesh mesh, std::uint64_t material) {
    mesh.materials.assign(mesh.triangles.size(), static_cast<std::uint32_t>(material));
    add(std::move(mesh));
}

void MeshCollector::add(ImportedMesh mesh) {
    for (std::uint32_t& material : mesh.materials) material += static_cast<std::uint32_t>(first_material_);
    file_.triangles += mesh.triangles.size();
    imported_.meshes.push_back(std::move(mesh));
}

}  // namespace espalier::tools
