#include "verify_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/nearest.hpp>

#include "numbers.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t most_checked = 100'000;

bool is_finite(Vec3 point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }

/// The vertices that some triangle uses, each once, ascending.
std::vector<std::uint32_t> used_vertices(const ImportedMesh& mesh) {
    std::vector<bool> used(mesh.positions.size());
    for (const TriangleVertices& triangle : mesh.triangles) {
        const auto within = [&](std::uint32_t index) {
            return index < used.size() && is_finite(mesh.positions[index]);
        };
        if (!std::all_of(triangle.begin(), triangle.end(), within)) continue;
        for (const std::uint32_t index : triangle) used[index] = true;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t index = 0; index < used.size(); ++index) {
        if (used[index]) result.push_back(index);
    }
    return result;
}

/// How far the measured distance may lie above the true one: closest_point rounds the point onto its own grid, and its
/// answer by some ulp of the coordinates (nearest.hpp).
double measuring_error(const Blob& blob, Vec3 point) {
    const double largest = std::max({std::abs(double{point.x}), std::abs(double{point.y}), std::abs(double{point.z})});
    const double spacing = double{std::numeric_limits<float>::epsilon()};
    return double{blob.step()} / 64.0 + 8.0 * spacing * (largest + double{blob.max_error()});
}

}  // namespace

SourceCheck check_source(const Blob& blob, const Imported& source) {
    std::vector<std::vector<std::uint32_t>> used;
    SourceCheck check;
    for (const ImportedMesh& mesh : source.meshes) {
        used.push_back(used_vertices(mesh));
        check.vertices += used.back().size();
    }
    const std::uint64_t stride = std::max<std::uint64_t>(1, (check.vertices + most_checked - 1) / most_checked);
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        for (const std::uint32_t vertex : used[i]) {
            if (number++ % stride != 0) continue;
            const ImportedMesh& mesh = source.meshes[i];
            const Vec3 point = mesh.positions[vertex];
            Nearest nearest;
            const bool found = closest_point(blob, point, std::numeric_limits<float>::infinity(), nearest);
            const double distance = found ? double{nearest.distance} : std::numeric_limits<double>::infinity();
            ++check.checked;
            if (distance > double{blob.max_error()} + measuring_error(blob, point)) ++check.too_far;
            if (distance > check.worst_distance) {
                check.worst_distance = distance;
                check.worst = text(mesh.name, ", vertex ", vertex);
            }
        }
    }
    return check;
}

}  // namespace espalier::tools
