// Trees of one topology with volumes of each kind in their nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../traversal/aabb_tree.hpp"
#include "stored.hpp"

namespace espalier::bench {

/// Fits volumes to the triangles of each node. One entry for each node of the tree.
[[nodiscard]] std::vector<Volumes> fit_nodes(const AabbTree& topology);

template <class Stored>
struct VolumeNode {
    Stored volume;
    std::uint32_t first;  ///< the first of two children; of a leaf, its first triangle
    std::uint32_t count;  ///< of a leaf, the number of its triangles; 0: the node has children
};

/// A tree with the nodes of `topology` in the same order, and its triangles.
template <class Stored>
struct VolumeTree {
    using Volume = Stored;
    VolumeTree(const AabbTree& of, std::span<const Volumes> volumes) : topology(&of) {
        const double margin = stored_margin_share * static_cast<double>(of.largest);
        nodes.resize(of.nodes.size());
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            store(volumes[i], margin, nodes[i].volume);
            nodes[i].first = of.nodes[i].first;
            nodes[i].count = of.nodes[i].count;
        }
    }
    [[nodiscard]] std::span<const FloatTriangle> triangles_of(const VolumeNode<Stored>& leaf) const {
        return std::span(topology->triangles).subspan(leaf.first, leaf.count);
    }

    const AabbTree* topology;
    std::vector<VolumeNode<Stored>> nodes;
};

}  // namespace espalier::bench
