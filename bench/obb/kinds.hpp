// The kinds of tree that are compared: two topologies, and on each the boxes and their tests.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "../traversal/pair_walk.hpp"
#include "box_trees.hpp"

namespace espalier::bench {

/// Processor time.
struct BuildSeconds {
    double obb_tree = 0.0;  ///< of build_obb_tree
    double fit = 0.0;       ///< of oriented boxes for a tree that is there
};

/// All trees of a mesh.
struct MeshTrees {
    /// `sah` has one triangle in each leaf and outlives this.
    MeshTrees(const AabbTree& sah, BuildSeconds& seconds);
    MeshTrees(const MeshTrees&) = delete;
    MeshTrees& operator=(const MeshTrees&) = delete;

    const AabbTree* sah;
    ObbTree by_obbs;
    BoxNodes<StoredObb> sah_obbs;
    BoxNodes<StoredAabb> sah_aabbs, by_obbs_aabbs;
};

struct TreeKind {
    const char* topology;    ///< "obb": of build_obb_tree; "sah": of the tree for axis-aligned boxes
    const char* boxes;       ///< "obb"; "aabb turned": by 15 axes; "aabb reboxed": by 3
    std::size_t node_bytes;  ///< of the box and the link
    /// Returns what answers a question for a pose of the second mesh. Both meshes outlive it.
    std::function<std::function<PairWork(const Transform& pose)>(const MeshTrees& a, const MeshTrees& b, PairQuestion)>
        walk;
};
[[nodiscard]] std::span<const TreeKind> all_tree_kinds();

}  // namespace espalier::bench
