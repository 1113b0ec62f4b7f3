// A binary tree over the triangles of a mesh, with one triangle in each leaf, as the textbook has it: a shape, and
// boxes of two kinds over it. Axis-aligned boxes (AABB) are renewed from the bottom up (van den Bergen 1997); oriented
// boxes (OBB) are fitted anew to all triangles of each node.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../rays.hpp"

namespace espalier::bench {

/// Which triangles are in which node.
struct BoxTreeShape {
    struct Node {
        std::uint32_t right;  ///< the number of the second child; the first follows the node. 0: a leaf
        std::uint32_t first;  ///< in `triangles`
        std::uint32_t count;
    };
    std::vector<Node> nodes;  ///< children come after their parents
    std::vector<TriangleVertices> triangles;

    [[nodiscard]] std::span<const TriangleVertices> triangles_of(const Node& node) const {
        return std::span(triangles).subspan(node.first, node.count);
    }
};

/// Builds from the top down: a node is split at the best of 16 bins along each axis (surface area heuristic).
BoxTreeShape build_box_tree(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions);

struct Aabb {
    std::array<float, 3> low, high;

    /// Returns one that is empty.
    static Aabb none();
    void add(const Vec3& point);
    void add(const Aabb& box);
    [[nodiscard]] bool contains(const Vec3& point, float rounding) const;
    [[nodiscard]] double half_area() const;
};

struct Obb {
    std::array<Vec3, 3> axes;        ///< of length 1, perpendicular
    std::array<float, 3> low, high;  ///< along the axes

    [[nodiscard]] bool contains(const Vec3& point, float rounding) const;
    [[nodiscard]] double half_area() const;
};

/// Renews the boxes of all nodes; `boxes` has as many.
void refit_aabbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Aabb> boxes);

/// Fits a box to the vertices of each node: axes are the eigenvectors of their covariance (Gottschalk, Lin, Manocha
/// 1996); of a leaf, its longest edge and its normal.
void fit_obbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Obb> boxes);

/// Returns the sum of half the areas of all boxes.
template <class Boxes>
double total_half_area(const Boxes& boxes) {
    double sum = 0.0;
    for (const auto& box : boxes) sum += box.half_area();
    return sum;
}

}  // namespace espalier::bench
