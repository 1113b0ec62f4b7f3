// Fourth stage: which nodes of the binary tree become wide nodes and leaves.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/format.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/leaf_size.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// One child of a wide node: a node of the binary tree, kept as a leaf or to become a wide node itself.
struct Child {
    std::uint32_t binary_node;
    bool is_leaf;
};

struct Children {
    std::array<Child, format::max_children> slots;
    unsigned count = 0;
    void add(Child child) { slots[count++] = child; }
    [[nodiscard]] std::span<Child> list() { return {slots.data(), count}; }
};

/// What the plan expects an average ray to cost, in visits of a node. The defaults are committed, since no clock may
/// enter the bytes; bench/cost_model fits them to a machine.
struct RayCosts {
    float node_visit = 1.0f;
    float leaf_visit = 0.4f;
    float leaf_group = 0.3f;  ///< for each started group of 8 triangles of a visited leaf
};

struct CollapseSettings {
    Profile profile = Profile::fast;
    RayCosts costs;
    float byte_price = 5.0f;                                   ///< BuildOptions::byte_price
    unsigned max_leaf_triangles = format::max_leaf_triangles;  ///< at least 1
};

/// The cheapest choice for every subtree, found by dynamic programming. It minimises
///   sum over nodes and leaves of (area / the root's area) * cost + byte_price * bytes / triangles.
class CollapsePlan {
public:
    CollapsePlan(const LatticeMesh& mesh, const BinaryTree& tree, const LeafSizes& sizes,
                 const CollapseSettings& settings);

    /// The children of the wide node that stands for `binary_node`, when at most `levels` nodes, itself included, may
    /// lie on the way down. Requires height(binary_node) <= 3 * levels, and gives children that are leaves or meet the
    /// same with levels - 1.
    [[nodiscard]] Children children_of(std::uint32_t binary_node, unsigned levels) const;

private:
    friend class CollapsePlanner;
    void add_roots(std::uint32_t binary_node, unsigned roots, Children& children) const;
    void add_all(std::uint32_t binary_node, unsigned levels_below, Children& children) const;
    [[nodiscard]] Child child_for(std::uint32_t binary_node) const;

    const BinaryTree& tree_;
    unsigned most_children_;              // of a wide node
    std::vector<std::uint64_t> choices_;  // for each binary node, see `Choice`
};

}  // namespace espalier::baker
