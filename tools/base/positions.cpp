#include "positions.hpp"

#include <algorithm>
#include <cmath>

#include <import/base/placement.hpp>

#include "vectors.hpp"

namespace espalier::tools {

std::vector<Vec3> positions_in_a_row(const ImportResult& imported, const Vec3d& origin) {
    std::vector<Vec3> row;
    for (const ImportedMesh& mesh : imported.meshes)
        for (const Vec3d& position : mesh.positions) row.push_back(to_float32(position - origin));
    return row;
}

std::optional<std::size_t> first_not_finite(const std::vector<Vec3>& positions) {
    const auto found =
        std::find_if_not(positions.begin(), positions.end(), [](const Vec3& each) { return is_finite(each); });
    if (found == positions.end()) return std::nullopt;
    return static_cast<std::size_t>(found - positions.begin());
}

std::string words_for_not_finite(Vec3 position) {
    const float value = !std::isfinite(position.x) ? position.x : !std::isfinite(position.y) ? position.y : position.z;
    const char axis = !std::isfinite(position.x) ? 'x' : !std::isfinite(position.y) ? 'y' : 'z';
    return text(axis, " = ", std::isnan(value) ? "NaN" : value > 0.0f ? "infinity" : "-infinity");
}

void refuse_position(const ImportResult& imported, std::size_t position, const std::string& problem,
                     const std::string& kind) {
    std::size_t vertex = position;
    auto mesh = imported.meshes.begin();
    while (vertex >= mesh->positions.size()) vertex -= (mesh++)->positions.size();
    throw CommandError(ExitCode::invalid_input, text(mesh->name, ", vertex ", vertex, ' ', problem),
                       {.file = imported.files.at(mesh->file).path, .mesh = mesh->mesh, .kind = kind});
}

}  // namespace espalier::tools
