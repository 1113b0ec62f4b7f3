#include "source_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <espalier/distance.hpp>

#include "base/numbers.hpp"

namespace espalier::tools {

namespace {

constexpr std::uint64_t most_checked = 100'000;

bool is_finite(Vec3 point) { return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z); }

std::array<double, 3> difference(Vec3 to, Vec3 from) {
    const auto along = [](float a, float b) { return static_cast<double>(a) - static_cast<double>(b); };
    return {along(to.x, from.x), along(to.y, from.y), along(to.z, from.z)};
}

bool has_area(Vec3 a, Vec3 b, Vec3 c) {
    const std::array<double, 3> u = difference(b, a);
    const std::array<double, 3> v = difference(c, a);
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

/// The vertices that some sound triangle uses, each once, ascending.
std::vector<std::uint32_t> used_vertices(const ImportedMesh& mesh, SourceCheck& check) {
    std::vector<bool> used(mesh.positions.size());
    for (const TriangleVertices& triangle : mesh.triangles) {
        const auto sound = [&](std::uint32_t index) { return index < used.size() && is_finite(mesh.positions[index]); };
        if (!std::all_of(triangle.begin(), triangle.end(), sound)) continue;
        for (const std::uint32_t index : triangle) used[index] = true;
        const auto corner = [&](std::size_t number) { return mesh.positions[triangle[number]]; };
        if (has_area(corner(0), corner(1), corner(2))) ++check.triangles_with_area;
    }
    std::vector<std::uint32_t> result;
    for (std::uint32_t index = 0; index < used.size(); ++index) {
        if (used[index]) result.push_back(index);
    }
    check.vertices += result.size();
    return result;
}

/// How far the measured distance may lie above the true one. closest_point answers for the point as it rounds it:
/// relative to the lattice's origin in float32, then onto a grid that is finer than the lattice as far as float32 can
/// carry it. Its distance from there is within 4 ulp (nearest.hpp).
double measuring_error_at(const Blob& blob, Vec3 point, double distance) {
    const float* origin = detail::data_of(blob).origin;
    const std::array<double, 3> offset = difference(point, {origin[0], origin[1], origin[2]});
    const double reach = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
    const int finer_by = std::clamp(23 - static_cast<int>(detail::data_of(blob).bits), 0, 6);
    const double on_each_axis = std::ldexp(1.0, blob.lattice().step_exponent - finer_by - 1) + std::ldexp(reach, -24);
    return std::sqrt(3.0) * on_each_axis + std::ldexp(distance, -21);
}

void check_vertex(const Blob& blob, const ImportedMesh& mesh, std::uint32_t vertex, SourceCheck& check) {
    const Vec3 point = mesh.positions[vertex];
    const auto distance = static_cast<double>(closest_point(blob, point).distance);
    const double error = measuring_error_at(blob, point, distance);
    ++check.checked;
    if (distance > static_cast<double>(blob.max_error()) + error) ++check.too_far;
    check.measuring_error = std::max(check.measuring_error, error);
    if (distance > check.worst_distance) {
        check.worst_distance = distance;
        check.worst = text(mesh.name, ", vertex ", vertex);
    }
}

}  // namespace

SourceCheck check_source(const Blob& blob, const Imported& source) {
    SourceCheck check;
    std::vector<std::vector<std::uint32_t>> used;
    for (const ImportedMesh& mesh : source.meshes) used.push_back(used_vertices(mesh, check));
    if (blob.triangle_count() == 0) return check;
    const std::uint64_t stride = std::max<std::uint64_t>(1, (check.vertices + most_checked - 1) / most_checked);
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < used.size(); ++i) {
        for (const std::uint32_t vertex : used[i]) {
            if (number++ % stride == 0) check_vertex(blob, source.meshes[i], vertex, check);
        }
    }
    return check;
}

}  // namespace espalier::tools
