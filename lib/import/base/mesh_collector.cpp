#include <import/base/mesh_collector.hpp>

#include <algorithm>
#include <utility>

#include <espalier/format.hpp>

#include <import/base/error.hpp>
#include <import/base/text_file.hpp>

namespace espalier::importer {

namespace {

/// One instance is left for the meshes that are merged.
constexpr std::uint64_t most_places = format::scene::max_instances - 1;
/// The copies of meshes in one file: each becomes a mesh with a name, a number and vertices of its own.
constexpr std::uint64_t most_copies = std::uint64_t{1} << 20;
/// The bytes of the names of all meshes in one file, and of the paths of their nodes: a name that a file has once may
/// be that of all its meshes.
constexpr std::uint64_t most_name_bytes = std::uint64_t{1} << 28;

ImportedFile new_record(const std::string& path, const char* format, const ImportOptions& options) {
    ImportedFile record;
    record.path = path;
    record.opened.push_back(path);
    record.format = format;
    record.metres_per_unit = options.metres_per_unit.value_or(1.0);
    record.unit_origin = options.metres_per_unit ? "--unit" : "not stated";
    return record;
}

}  // namespace

std::uint64_t unused_vertices(std::size_t vertices, const std::vector<TriangleVertices>& triangles) {
    std::vector<bool> is_used(vertices);
    for (const TriangleVertices& triangle : triangles) {
        for (const std::uint32_t vertex : triangle) {
            if (vertex < is_used.size()) is_used[vertex] = true;
        }
    }
    return static_cast<std::uint64_t>(std::count(is_used.begin(), is_used.end(), false));
}

void set_materials(ImportedFile& file, const std::vector<std::string>& names) {
    file.materials = names.size();
    file.material_names.clear();
    for (const std::string& name : names) file.material_names.push_back(utf8_name(name));
}

MeshCollector::MeshCollector(const ImportOptions& options, ImportedFile& file, ImportResult& imported)
    : options_(options), file_(file), imported_(imported) {
    for (const ImportedFile& earlier : imported.files) first_material_ += earlier.materials;
    for (const ImportedMesh& mesh : imported.meshes) triangles_ += mesh.triangles.size();
}

Placement MeshCollector::asset_placement() const {
    const Placement asset = scaled_by(options_.scale * file_.metres_per_unit);
    return options_.up ? combine(turned_to_y_up(*options_.up), asset) : asset;
}

void MeshCollector::require_room(std::uint64_t triangles, std::string_view words) const {
    if (triangles <= format::max_triangles && triangles_ + triangles <= format::max_triangles) return;
    throw_error(ImportStatus::unsupported, words, ": with it the files have more than ", format::max_triangles,
                " triangles, the most a blob can hold. Bake them in parts.");
}

void MeshCollector::require_copies(std::uint64_t copies, std::string_view words) const {
    if (keeps_places() || copies <= most_copies) return;
    throw_error(
        ImportStatus::unsupported, words, ": with it the file has more than ", most_copies,
        " copies of its meshes. Bake it as a scene, which has a mesh at many places once (--instances auto), or "
        "in parts.");
}

void MeshCollector::require_places(std::uint64_t places, std::string_view words) const {
    if (places <= most_places && imported_.places.size() + places <= most_places) return;
    throw_error(ImportStatus::unsupported, words, ": with it the files place meshes more than ", most_places,
                " times, the most that a scene can hold. Bake them in parts.");
}

ImportedMesh MeshCollector::begin(std::string_view given, std::uint64_t triangles, std::string_view path) {
    const std::string name = utf8_name(given);
    ImportedMesh mesh;
    mesh.file = static_cast<std::uint32_t>(imported_.files.size());
    mesh.mesh = file_.meshes++;
    name_bytes_ += name.size();
    if (name_bytes_ > most_name_bytes) {
        throw_file_error(ImportStatus::unsupported, file_.path, ", mesh ", mesh.mesh,
                         ": with it the names of the file's meshes have more than ", most_name_bytes,
                         " bytes, as many meshes repeat a long one. Shorten it.");
    }
    path_bytes_ += path.size();
    file_.mesh_paths.emplace_back(path_bytes_ > most_name_bytes ? std::string_view() : path);
    file_.mesh_names.push_back(name);
    mesh.name = words_for_mesh(file_, mesh.mesh, name);
    require_room(triangles, mesh.name);
    return mesh;
}

std::uint32_t MeshCollector::add(ImportedMesh mesh, std::uint64_t material, const Placement& placement) {
    mesh.materials.assign(mesh.triangles.size(), static_cast<std::uint32_t>(material));
    return add(std::move(mesh), placement);
}

std::uint32_t MeshCollector::add(ImportedMesh mesh, const Placement& placement) {
    const auto index = static_cast<std::uint32_t>(imported_.meshes.size());
    for (std::uint32_t& material : mesh.materials) material += static_cast<std::uint32_t>(first_material_);
    triangles_ += mesh.triangles.size();
    imported_.meshes.push_back(std::move(mesh));
    if (keeps_places()) {
        add_place(index, imported_.meshes[index], placement);
    } else {
        file_.triangles += imported_.meshes[index].triangles.size();
    }
    return index;
}

void MeshCollector::add_place(std::uint32_t mesh, const ImportedMesh& numbered, const Placement& placement) {
    require_places(1, numbered.name);
    file_.triangles += imported_.meshes[mesh].triangles.size();
    imported_.places.push_back({mesh, numbered.file, numbered.mesh, placement});
}

std::string words_for_mesh(const ImportedFile& file, std::uint32_t number, std::string_view name) {
    return text(printable(file.path), ", mesh ", number, name.empty() ? "" : text(" (", printable(name), ")"));
}

UnitlessFile::UnitlessFile(const std::string& path, const char* format, const ImportOptions& options,
                           ImportResult& imported)
    : imported_(imported), record_(new_record(path, format, options)), meshes_(options, record_, imported) {}

void UnitlessFile::add(const std::string& name, std::vector<Vec3d> positions, std::vector<TriangleVertices> triangles,
                       std::vector<std::uint32_t> materials) {
    ImportedMesh mesh = meshes_.begin(name, triangles.size());
    const Placement placement = meshes_.asset_placement();
    const Placement applied = meshes_.applied(placement);
    for (Vec3d& position : positions) position = applied(position);
    materials.resize(triangles.size());
    mesh.positions = std::move(positions);
    mesh.triangles = std::move(triangles);
    mesh.materials = std::move(materials);
    meshes_.add(std::move(mesh), placement);
}

void UnitlessFile::add_triangles(const std::string& name, std::vector<Vec3d> corners) {
    std::vector<TriangleVertices> triangles(corners.size() / 3);
    std::uint32_t next = 0;
    for (TriangleVertices& triangle : triangles)
        for (std::uint32_t& vertex : triangle) vertex = next++;
    if (!triangles.empty()) add(name, std::move(corners), std::move(triangles), {});
}

void UnitlessFile::leave_out_zero_bytes(std::string& content) {
    const std::size_t end = content.find_last_not_of('\0') + 1;
    if (end == content.size()) return;
    warn("trailing_bytes", text(": ", counted(content.size() - end, "zero byte"),
                                " after the text were not read. Export the file again if it is not whole."));
    content.resize(end);
}

void UnitlessFile::warn(const char* kind, const std::string& message) {
    add_warning(record_, kind, text(printable(path()), message));
}

void UnitlessFile::finish() {
    if (record_.materials == 0) set_materials(record_, {""});
    imported_.files.push_back(std::move(record_));
}

}  // namespace espalier::importer
