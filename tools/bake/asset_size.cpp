#include "asset_size.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <baker/input/zero_area.hpp>

namespace espalier::tools {

namespace {

/// The bounds of points along one axis.
struct Range {
    float low = std::numeric_limits<float>::infinity();
    float high = -std::numeric_limits<float>::infinity();

    void add(float value) {
        low = std::min(low, value);
        high = std::max(high, value);
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

}  // namespace

AssetSize asset_size(const Imported& imported) {
    std::array<Range, 3> bounds;
    for (const ImportedMesh& mesh : imported.meshes) {
        for (const TriangleVertices& triangle : mesh.triangles) {
            if (!is_sound(mesh, triangle)) continue;
            for (const std::uint32_t vertex : triangle) {
                const Vec3 point = mesh.positions[vertex];
                bounds[0].add(point.x);
                bounds[1].add(point.y);
                bounds[2].add(point.z);
            }
        }
    }
    AssetSize size;
    for (const Range& range : bounds) {
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
