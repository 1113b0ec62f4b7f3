#include "asset_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <baker/input/zero_area.hpp>

namespace espalier::tools {

namespace {

/// The bounds of points along one axis.
struct Interval {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();

    void add(float value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

struct Bounds {
    std::array<Interval, 3> axes;

    void add(Vec3 point) {
        axes[0].add(point.x);
        axes[1].add(point.y);
        axes[2].add(point.z);
    }
};

bool is_sound(const ImportedMesh& mesh, const TriangleVertices& triangle) {
    const auto is_finite = [&mesh](std::uint32_t vertex) {
        if (vertex >= mesh.positions.size()) return false;
        const Vec3 point = mesh.positions[vertex];
        return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
    };
    return std::all_of(triangle.begin(), triangle.end(), is_finite) &&
           !baker::has_zero_area(mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]);
}

/// Returns the vertices of triangles with an area, ascending.
std::vector<std::uint32_t> sound_vertices(const ImportedMesh& mesh) {
    std::vector<bool> is_used(mesh.positions.size());
    for (const TriangleVertices& triangle : mesh.triangles) {
        if (!is_sound(mesh, triangle)) continue;
        for (const std::uint32_t vertex : triangle) is_used[vertex] = true;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t vertex = 0; vertex < is_used.size(); ++vertex)
        if (is_used[vertex]) result.push_back(vertex);
    return result;
}

}  // namespace

AssetSize asset_size(const Imported& imported) {
    std::vector<std::vector<std::uint32_t>> vertices;
    for (const ImportedMesh& mesh : imported.meshes) vertices.push_back(sound_vertices(mesh));
    Bounds bounds;
    for (const ImportedPlace& place : imported.places) {
        for (const std::uint32_t vertex : vertices[place.mesh])
            bounds.add(place.placement(imported.meshes[place.mesh].positions[vertex]));
    }
    for (std::size_t i = 0; imported.places.empty() && i < vertices.size(); ++i) {
        for (const std::uint32_t vertex : vertices[i]) bounds.add(imported.meshes[i].positions[vertex]);
    }
    AssetSize size;
    for (const Interval& range : bounds.axes) {
        if (range.low > range.high) continue;
        const double low = static_cast<double>(range.low);
        const double high = static_cast<double>(range.high);
        if (high - low <= size.extent) continue;
        // Two corners, each rounded when it was read and when it was placed, each time by half a unit in the last
        // place.
        size = {high - low, std::ldexp(std::max(std::abs(low), std::abs(high)), -22)};
    }
    return size;
}

}  // namespace espalier::tools
