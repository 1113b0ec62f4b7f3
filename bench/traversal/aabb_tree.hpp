// A textbook tree: a binary hierarchy of axis-aligned boxes (AABB) in float, with a few triangles in each leaf.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../rays.hpp"

namespace espalier::bench {

/// A node of 32 bytes. The two children are neighbours, so that both lie in one cache line.
struct AabbNode {
    float center[3];
    float half[3];        ///< half of the sides
    std::uint32_t first;  ///< the first child; of a leaf, its first triangle
    std::uint32_t count;  ///< of a leaf, the number of its triangles; 0: the node has children

    [[nodiscard]] bool is_leaf() const { return count != 0; }
};
static_assert(sizeof(AabbNode) == 32);

/// The corners of a triangle.
using FloatTriangle = std::array<Vec3, 3>;

struct AabbTree {
    std::vector<AabbNode> nodes;  ///< the root is the first
    std::vector<FloatTriangle> triangles;
    unsigned height = 0;   ///< levels below the root
    float largest = 0.0f;  ///< coordinate, or a larger one

    [[nodiscard]] std::span<const FloatTriangle> triangles_of(const AabbNode& leaf) const {
        return std::span(triangles).subspan(leaf.first, leaf.count);
    }
};

/// A tree, and the blob that is baked from the same binary tree.
struct TreeAndBlob {
    AabbTree tree;
    std::vector<std::byte> blob;
    double tree_seconds = 0.0;  ///< processor time of building the tree
};

/// Builds a tree as the baker does (binned SAH, reinsertion) and stops at leaves of `most_leaf_triangles`. The blob has
/// profile `fast`. Throws std::runtime_error with the mesh's name.
///
/// Boxes are larger than their triangles by a few millionths of the largest coordinate, which covers what float rounds
/// off in the tests of boxes: no walk skips a box that has a hit.
TreeAndBlob build_tree_and_blob(const Mesh& mesh, unsigned most_leaf_triangles);

}  // namespace espalier::bench
