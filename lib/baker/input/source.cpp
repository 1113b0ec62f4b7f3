#include <baker/input/source.hpp>

#include <algorithm>

namespace espalier::baker {

namespace {

/// Returns the mesh that owns an id: where several start at the same id all but the last are empty.
std::size_t mesh_of(const Source& source, std::uint32_t original_id) {
    const auto after = std::upper_bound(source.first_triangle.begin(), source.first_triangle.end(), original_id);
    return static_cast<std::size_t>(after - source.first_triangle.begin()) - 1;
}

}  // namespace

std::string mesh_name(std::span<const MeshView> meshes, std::size_t mesh) {
    const std::string& given = meshes[mesh].name;
    return given.empty() ? "mesh " + std::to_string(mesh) : given;
}

std::string triangle_name(const Source& source, std::uint32_t original_id) {
    const std::size_t mesh = mesh_of(source, original_id);
    return mesh_name(source.meshes, mesh) + ", triangle " + std::to_string(original_id - source.first_triangle[mesh]);
}

SourcePlace place_of(const MeshView& mesh) { return {mesh.file, mesh.mesh}; }

SourcePlace place_of(const Source& source, std::uint32_t original_id) {
    const OriginalTriangle original = original_triangle(source, original_id);
    return {original.file, original.mesh, original.triangle};
}

Finding first_finding(const Source& source, std::uint32_t original_id) {
    return {1, triangle_name(source, original_id), place_of(source, original_id)};
}

OriginalTriangle original_triangle(const Source& source, std::uint32_t original_id) {
    const std::size_t mesh = mesh_of(source, original_id);
    return {source.meshes[mesh].file, source.meshes[mesh].mesh, original_id - source.first_triangle[mesh], 0};
}

std::uint32_t material_of(const Source& source, std::uint32_t original_id) {
    const std::size_t mesh = mesh_of(source, original_id);
    const auto materials = source.meshes[mesh].materials;
    return materials.empty() ? 0 : materials[original_id - source.first_triangle[mesh]];
}

}  // namespace espalier::baker
