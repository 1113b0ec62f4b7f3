// The tree over the instances of a scene: packed nodes, each leaf an instance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <baker/encode/node.hpp>

namespace espalier::baker {

/// A tree, and the order of the instances in it.
struct InstanceTree {
    std::vector<std::byte> nodes;      ///< in depth-first order
    std::vector<std::uint32_t> order;  ///< the box of each instance, in the order of the leaves
    unsigned depth = 0;
};

/// Builds the tree by the stages that build the tree of a mesh: binned heuristic, reinsertion, cheapest collapse.
/// O(n log n) for n boxes.
[[nodiscard]] InstanceTree build_instance_tree(std::span<const ChildBox> boxes);

}  // namespace espalier::baker
