#include "vertices.hpp"

#include <algorithm>
#include <vector>

#include <import/base/numbers.hpp>

#include "base/exit_code.hpp"
#include "measure.hpp"
#include "source_places.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t most_vertices_checked = 100'000;

/// Returns the vertices that some sound triangle uses, each once, ascending.
std::vector<std::uint32_t> vertices_in_use(const ImportedMesh& mesh) {
    std::vector<bool> is_used(mesh.positions.size());
    for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        if (!corners_of(mesh, triangle)) continue;
        for (const std::uint32_t vertex : mesh.triangles[triangle]) is_used[vertex] = true;
    }
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t vertex = 0; vertex < is_used.size(); ++vertex)
        if (is_used[vertex]) vertices.push_back(vertex);
    return vertices;
}

template <class Surface>
VertexCheck check(const Surface& surface, const ImportResult& source) {
    VertexCheck result;
    std::vector<std::vector<std::uint32_t>> used;
    for (const ImportedMesh& mesh : source.meshes) used.push_back(vertices_in_use(mesh));
    const std::vector<ImportedPlace> places = places_of(source);
    for (const ImportedPlace& place : places) result.vertices += used[place.mesh].size();
    const std::uint64_t stride =
        std::max<std::uint64_t>(1, (result.vertices + most_vertices_checked - 1) / most_vertices_checked);
    std::uint64_t next = 0;  // of the place's vertices
    for (const ImportedPlace& place : places) {
        const std::vector<std::uint32_t>& vertices = used[place.mesh];
        for (; next < vertices.size(); next += stride) {
            const Vec3d point = place.placement(source.meshes[place.mesh].positions[vertices[next]]);
            const auto [distance, error] = measure(surface, point);
            ++result.checked;
            if (distance > double(surface.max_error()) + error) ++result.too_far;
            result.measuring_error = std::max(result.measuring_error, error);
            if (distance <= result.worst_distance) continue;
            result.worst_distance = distance;
            result.worst = text(name_of_place(source, place), ", vertex ", vertices[next]);
        }
        next -= vertices.size();
    }
    return result;
}

}  // namespace

VertexCheck check_vertices(const Blob& blob, const ImportResult& source) { return check(blob, source); }
VertexCheck check_vertices(const BakedScene& scene, const ImportResult& source) { return check(scene, source); }

}  // namespace espalier::tools
