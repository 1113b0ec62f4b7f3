#include "placed_mesh.hpp"

#include <utility>

namespace espalier::tools {

std::string words_for_place(const Imported& imported, const ImportedPlace& place) {
    const ImportedFile& file = imported.files.at(place.file);
    return words_for_mesh(file, place.number, file.mesh_names.at(place.number));
}

ImportedMesh placed_mesh(const Imported& imported, const ImportedPlace& place, const Placement& placement) {
    ImportedMesh mesh = imported.meshes.at(place.mesh);
    for (Vec3& position : mesh.positions) position = placement(position);
    if (placement.mirrors())
        for (TriangleVertices& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    mesh.file = place.file;
    mesh.mesh = place.number;
    mesh.name = words_for_place(imported, place);
    return mesh;
}

}  // namespace espalier::tools
