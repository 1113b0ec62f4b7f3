// A textbook tree: a binary hierarchy of axis-aligned boxes (AABB) in float, with a few triangles in each leaf.
#pragma once

#include "shapes.hpp"

namespace espalier::bench {

/// A node with a volume of one kind. The two children are neighbours.
template <class Stored>
struct VolumeNode : Stored {
    std::uint32_t first;  ///< the first child; of a leaf, its first triangle
    std::uint32_t count;  ///< of a leaf, the number of its triangles; 0: the node has children

    [[nodiscard]] bool is_leaf() const { return count != 0; }
};
/// Both children lie in one cache line.
using AabbNode = VolumeNode<StoredAabb>;
static_assert(sizeof(AabbNode) == 32);

/// The corners of a triangle.
using FloatTriangle = std::array<Vec3, 3>;

struct AabbTree {
    std::vector<AabbNode> nodes;  ///< the root is the first
    std::vector<FloatTriangle> triangles;
    unsigned height = 0;   ///< levels below the root
    float largest = 0.0f;  ///< coordinate, or a larger one

    template <class Stored>
    [[nodiscard]] std::span<const FloatTriangle> triangles_of(const VolumeNode<Stored>& leaf) const {
        return std::span(triangles).subspan(leaf.first, leaf.count);
    }
};

/// Nodes with volumes of one kind, in the order of the tree that they belong to.
template <class Stored>
struct NodesOfTree {
    const AabbTree* tree;
    std::span<const VolumeNode<Stored>> nodes;
};

/// Numbers of a tree's triangles: those of a node follow one another.
struct TriangleRange {
    std::size_t first;
    std::size_t end;
};
/// Returns one for each node.
[[nodiscard]] std::vector<TriangleRange> triangle_ranges(const AabbTree& tree);

/// A tree, and the blob that is baked from the same binary tree.
struct TreeAndBlob {
    AabbTree tree;
    BakedBlob baked;
    double build_seconds = 0.0;  ///< processor time of the baker for its binary tree
    double tree_seconds = 0.0;   ///< the same, and of the textbook tree
};

/// Builds a tree as the baker does (binned SAH, reinsertion) and stops at leaves of `most_leaf_triangles`. The blob has
/// profile `fast`. Throws std::runtime_error with the mesh's name.
///
/// Boxes are larger than their triangles by a few millionths of the largest coordinate, which covers what float rounds
/// off in the tests of boxes: no walk skips a box that has a hit.
TreeAndBlob build_tree_and_blob(const Mesh& mesh, unsigned most_leaf_triangles);

/// A mesh at the common size, its tree and its blob.
struct TreeSubject {
    TreeSubject(Mesh of, unsigned most_leaf_triangles) : mesh(std::move(of)) {
        bring_to_common_size(mesh);
        built = build_tree_and_blob(mesh, most_leaf_triangles);
    }
    [[nodiscard]] const AabbTree& tree() const { return built.tree; }
    [[nodiscard]] const Blob& blob() const { return built.baked.blob; }

    Mesh mesh;
    TreeAndBlob built;
};

// Triangles of the tree as the tests of triangles take them: in double.

inline Point point_of(const Vec3& p) {
    return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

[[nodiscard]] inline std::vector<Point> corners_in(const AabbTree& tree, const TriangleRange& range) {
    std::vector<Point> corners;
    for (std::size_t i = range.first; i < range.end; ++i)
        for (const Vec3& corner : tree.triangles[i]) corners.push_back(point_of(corner));
    return corners;
}

inline Corners3 corners_of(const FloatTriangle& triangle) {
    return {point_of(triangle[0]), point_of(triangle[1]), point_of(triangle[2])};
}
inline FloatTriangle triangle_of(const Mesh& mesh, const TriangleVertices& triangle) {
    return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}
inline Corners3 corners_of(const Mesh& mesh, const TriangleVertices& triangle) {
    return corners_of(triangle_of(mesh, triangle));
}
[[nodiscard]] inline std::vector<FloatTriangle> triangles_of(const Mesh& mesh) {
    std::vector<FloatTriangle> triangles;
    for (const TriangleVertices& triangle : mesh.triangles) triangles.push_back(triangle_of(mesh, triangle));
    return triangles;
}

// A triangle of the second tree, placed beside the first: which triangles touch it.

/// A triangle in a pose, with its plane. It is tested as in "Faster triangle-triangle intersection tests" (Devillers,
/// Guigue 2002), in double. Where a corner is too close to the other triangle's plane for its side to be certain, all
/// separating axes are tested instead.
class PlacedTriangle {
public:
    /// No coordinate of a triangle, placed or not, is larger than `largest`.
    PlacedTriangle(const FloatTriangle& triangle, const Pose& pose, double largest);
    [[nodiscard]] bool touches(const FloatTriangle& triangle) const;

private:
    Corners3 corners_;
    Point normal_;
    double height_;    ///< of the plane, along the normal
    double rounding_;  ///< of a height, for each unit of the normal
    double slack_;     ///< a height above the plane that is less than this has no certain sign
};

}  // namespace espalier::bench
