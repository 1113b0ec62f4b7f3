#include "source_places.hpp"

#include <algorithm>
#include <utility>

#include <import/base/importers.hpp>
#include <import/base/placement.hpp>

#include "base/exit_code.hpp"
#include "base/vectors.hpp"

namespace espalier::tools {

std::vector<ImportedPlace> places_of(const ImportResult& source) {
    if (!source.places.empty()) return source.places;
    std::vector<ImportedPlace> places;
    for (std::uint32_t i = 0; i < source.meshes.size(); ++i)
        places.push_back({i, source.meshes[i].file, source.meshes[i].mesh, {}});
    return places;
}

std::string name_of_place(const ImportResult& source, const ImportedPlace& place) {
    const ImportedFile& file = source.files.at(place.file);
    return words_for_mesh(file, place.number, file.mesh_names.at(place.number));
}

std::optional<SourceCorners> corners_of(const ImportedMesh& mesh, std::uint64_t triangle) {
    SourceCorners corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh.triangles[triangle][i];
        if (vertex >= mesh.positions.size() || !is_finite(mesh.positions[vertex])) return std::nullopt;
        corners[i] = mesh.positions[vertex];
    }
    return corners;
}

SourceCorners corners_at(const ImportedPlace& place, const SourceCorners& corners) {
    SourceCorners placed;
    std::transform(corners.begin(), corners.end(), placed.begin(), place.placement);
    if (place.placement.mirrors()) std::swap(placed[1], placed[2]);
    return placed;
}

bool are_corners_near(const SourceCorners& a, const SourceCorners& b, double tolerance) {
    const auto is_near = [&](std::size_t turn) {
        for (std::size_t i = 0; i < 3; ++i)
            if (!(length_of(a[i] - b[(i + turn) % 3]) <= tolerance)) return false;
        return true;
    };
    return is_near(0) || is_near(1) || is_near(2);
}

Vec3d middle_of(const SourceCorners& corners) {
    const auto& [a, b, c] = corners;
    return {(a.x + b.x + c.x) / 3.0, (a.y + b.y + c.y) / 3.0, (a.z + b.z + c.z) / 3.0};
}

}  // namespace espalier::tools
