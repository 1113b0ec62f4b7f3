#include "parallel_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "../pairs/poses.hpp"
#include "../traversal/corners.hpp"

namespace espalier::bench {
namespace {

/// Returns a number for each position, which is the same for equal ones: a mesh may have several vertices at one place.
std::vector<std::uint32_t> places_of(std::span<const Vec3> positions) {
    std::vector<std::uint32_t> order(positions.size()), place(positions.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    const auto key = [&](std::uint32_t i) { return std::tie(positions[i].x, positions[i].y, positions[i].z); };
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    for (std::size_t k = 0; k < order.size(); ++k)
        place[order[k]] = k > 0 && key(order[k]) == key(order[k - 1]) ? place[order[k - 1]] : order[k];
    return place;
}

}  // namespace

ParallelSurface parallel_surface_of(const Mesh& mesh, double gap) {
    ParallelSurface made;
    made.pose.rotation = {0.36f, -0.48f, 0.2f, 0.77f};
    const Matrix matrix = rotation_matrix(made.pose);
    const std::vector<std::uint32_t> place = places_of(mesh.positions);
    std::vector<Point> normals(mesh.positions.size(), Point{0.0, 0.0, 0.0});
    for (const TriangleVertices& triangle : mesh.triangles) {
        const Point a = point_of(mesh.positions[triangle[0]]);
        const Point across =
            cross(point_of(mesh.positions[triangle[1]]) - a, point_of(mesh.positions[triangle[2]]) - a);
        for (const std::uint32_t vertex : triangle) normals[place[vertex]] = normals[place[vertex]] + across;
    }
    made.mesh = mesh;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Point& normal = normals[place[i]];
        const double length = std::sqrt(dot(normal, normal));
        const Point moved = point_of(mesh.positions[i]) + (length > 0.0 ? gap / length : 0.0) * normal;
        const double from[3] = {moved.x, moved.y, moved.z};
        float to[3];
        for (int k = 0; k < 3; ++k)  // the inverse of a rotation is its transpose
            to[k] =
                static_cast<float>(matrix.at[0][k] * from[0] + matrix.at[1][k] * from[1] + matrix.at[2][k] * from[2]);
        made.mesh.positions[i] = {to[0], to[1], to[2]};
    }
    return made;
}

}  // namespace espalier::bench
