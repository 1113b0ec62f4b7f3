// The memory of a moving scene: one block without pointers, which its caller owns, copies and restores.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/transform.hpp>
#include <runtime/moving_scenes/box_tree/node.hpp>

namespace espalier::detail {

/// A slot of an instance. An odd generation is alive; a removed instance makes it even.
struct InstanceSlot {
    Transform transform;
    std::uint32_t mesh;
    std::uint32_t user;
    std::uint32_t generation;
    StepsBox box;
    std::uint32_t place;     ///< 8 * node + place in it; of a free slot the next free one
    std::int32_t origin[3];  ///< from which the transform counts, in steps (seen.hpp)
};
static_assert(sizeof(InstanceSlot) == 84);

/// The head of a block.
struct BlockHead {
    std::uint32_t magic;
    std::uint32_t slot_capacity;
    std::uint32_t node_capacity;
    std::int8_t step_exponent;
    std::uint8_t levels;  ///< nodes from the root to a leaf node; 0 without instances
    std::uint8_t must_refit;
    /// The number of the region of MovingScene::common_lattice() (common_lattice.hpp).
    std::uint8_t common_region;
    std::uint32_t live;        ///< instances
    std::uint32_t slots_used;  ///< slots that were ever alive; those behind are free
    std::uint32_t free_slot;   ///< the first of a list, or no_child
    std::uint32_t nodes_used;  ///< nodes that were used since the last repack; those behind are free
    std::uint32_t free_node;   ///< the first of a list linked by child[0], or no_child
    std::uint32_t free_nodes;  ///< the length of that list
    std::uint32_t root;        ///< no_child without instances
    std::uint32_t step;        ///< from 1 on
    Coarseness coarseness;     ///< of all instances since the last repack
    float packed_area;         ///< 1 + the area of boxes for each instance after the last repack; 0 before the first
};
static_assert(sizeof(BlockHead) == 64);

/// A block as its parts.
struct SceneBlock {
    BlockHead* head;
    BoxNode* nodes;
    InstanceSlot* slots;
    std::uint32_t* masks;   ///< of each slot, side by side: each pair of boxes that touch compares two
    std::uint32_t* moved;   ///< of each slot the step in which it was last moved or inserted
    std::uint32_t* counts;  ///< of each slot: room for the sort of pairs
    std::uint32_t* parent;  ///< of each node 8 * node + place in it, or no_child for the root
    /// For each node, whether its parent still has an old box of it. All zero after a refit, before which queries
    /// refuse.
    std::uint8_t* dirty;

    [[nodiscard]] BoxNode& node(std::uint32_t number) const { return nodes[number]; }
};

inline constexpr std::uint32_t block_magic = 0x324D5345u;  // "ESM2"
inline constexpr std::uint32_t most_slots = 1u << 24;
constexpr bool is_step_exponent(int exponent) { return exponent >= -100 && exponent <= 80; }
/// Nodes on the way to a leaf node, for so many slots: 13 levels would hold at least 2 * 4^12 instances.
inline constexpr std::uint32_t most_tree_levels = 12;

/// Returns how many nodes hold so many instances, however few children each node has, and one for each level: for the
/// splits of an insertion.
constexpr std::uint32_t most_nodes_of(std::uint32_t instances) {
    std::uint32_t nodes = 2, level = instances / BoxNode::least;
    for (; level > 1; level /= BoxNode::least) nodes += level + 1;
    return nodes;
}
/// Returns how many nodes a repack takes.
constexpr std::uint32_t packed_nodes_of(std::uint32_t instances) {
    std::uint32_t nodes = 0;
    do {
        instances = instances / BoxNode::most + (instances % BoxNode::most != 0 ? 1u : 0u);
        nodes += instances;
    } while (instances > 1);
    return nodes;
}
/// Returns the fewest nodes that a block may have: those of a repack, and room for its keys.
constexpr std::uint32_t least_nodes_of(std::uint32_t instances) {
    return packed_nodes_of(instances) + instances / 28 + 1;
}
constexpr std::uint64_t block_bytes(std::uint32_t slots, std::uint32_t nodes) {
    return sizeof(BlockHead) + (sizeof(InstanceSlot) + 12) * std::uint64_t{slots} +
           (sizeof(BoxNode) + 5) * std::uint64_t{nodes};
}

/// Returns the parts of a block, which begins at an address that 32 divides.
inline SceneBlock parts_of(std::byte* block, std::uint32_t slots, std::uint32_t nodes) {
    const auto take = [&block](std::uint64_t bytes) -> void* {
        std::byte* const part = block;
        block += static_cast<std::size_t>(bytes);
        return part;
    };
    SceneBlock parts{};
    parts.head = static_cast<BlockHead*>(take(sizeof(BlockHead)));
    parts.nodes = static_cast<BoxNode*>(take(sizeof(BoxNode) * std::uint64_t{nodes}));
    parts.slots = static_cast<InstanceSlot*>(take(sizeof(InstanceSlot) * std::uint64_t{slots}));
    parts.masks = static_cast<std::uint32_t*>(take(4 * std::uint64_t{slots}));
    parts.moved = static_cast<std::uint32_t*>(take(4 * std::uint64_t{slots}));
    parts.counts = static_cast<std::uint32_t*>(take(4 * std::uint64_t{slots}));
    parts.parent = static_cast<std::uint32_t*>(take(4 * std::uint64_t{nodes}));
    parts.dirty = static_cast<std::uint8_t*>(static_cast<void*>(block));
    return parts;
}
/// Returns the parts of a block with a head.
inline SceneBlock parts_of(std::byte* block) {
    const auto* const head = static_cast<const BlockHead*>(static_cast<const void*>(block));
    return parts_of(block, head->slot_capacity, head->node_capacity);
}

}  // namespace espalier::detail
