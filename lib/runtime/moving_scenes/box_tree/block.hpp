// The memory of a moving scene: one block without pointers, which its caller owns, copies and restores. It holds the
// nodes of the tree and the slots of instances.
#pragma once

#include <runtime/moving_scenes/box_tree/steps_box.hpp>

namespace espalier::detail {

inline constexpr std::uint32_t no_child = 0xFFFFFFFFu;

/// The boxes of up to eight children, in no order. A child is a node, or the slot of an instance at level 0. A place
/// without a child has an empty box, which touches nothing.
struct alignas(32) BoxNode {
    static constexpr unsigned most = 8;   ///< children
    static constexpr unsigned least = 4;  ///< of a node that is not the root

    std::int32_t low[3][most];
    std::int32_t high[3][most];
    std::uint32_t child[most];

    void clear() {
        for (unsigned i = 0; i < most; ++i) drop(i);
    }
    void drop(unsigned i) {
        set_box(i, StepsBox::none());
        child[i] = no_child;
    }
    void set(unsigned i, const StepsBox& box, std::uint32_t number) {
        set_box(i, box);
        child[i] = number;
    }
    void set_box(unsigned i, const StepsBox& box) {
        for (int k = 0; k < 3; ++k) {
            low[k][i] = box.low[k];
            high[k][i] = box.high[k];
        }
    }
    [[nodiscard]] StepsBox box(unsigned i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
    }
    /// Returns the box around all children.
    [[nodiscard]] StepsBox bounds() const {
        StepsBox all = StepsBox::none();
        for (unsigned i = 0; i < most; ++i) all.add(box(i));
        return all;
    }
    [[nodiscard]] unsigned count() const {
        unsigned children = 0;
        for (const std::uint32_t number : child) children += number != no_child ? 1u : 0u;
        return children;
    }
    /// Returns the first place without a child, or `most`.
    [[nodiscard]] unsigned free_place() const {
        for (unsigned i = 0; i < most; ++i)
            if (child[i] == no_child) return i;
        return most;
    }
};
static_assert(sizeof(BoxNode) == 224);

/// A slot of an instance. An odd generation is alive; a removed instance makes it even.
struct InstanceSlot {
    Transform transform;
    std::uint32_t mesh;
    std::uint32_t user;
    std::uint32_t generation;
    StepsBox box;
    std::uint32_t place;     ///< 8 * node + place in it; of a free slot the next free one
    std::int32_t origin[3];  ///< from which the transform counts, in steps
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
    /// The number of the region of MovingScene::common_lattice().
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

/// Writes an empty block. The address is one that 32 divides, with block_bytes() behind it.
inline SceneBlock make_block(std::byte* memory, std::uint32_t slots, std::uint32_t nodes, int step_exponent) {
    SceneBlock block = parts_of(memory, slots, nodes);
    BlockHead head{};
    head.magic = block_magic;
    head.slot_capacity = slots;
    head.node_capacity = nodes;
    head.step_exponent = static_cast<std::int8_t>(step_exponent);
    head.free_slot = head.free_node = head.root = no_child;
    head.step = 1;
    *block.head = head;
    return block;
}

inline bool is_live(const InstanceSlot& slot) { return (slot.generation & 1u) != 0; }

/// Returns whether a slot was moved or inserted since the last step ended.
inline bool has_moved(const SceneBlock& block, std::uint32_t slot) { return block.moved[slot] == block.head->step; }

/// Returns whether a slot below slots_used has had 2^31 lives, and gets no other: each has a generation of its own.
inline bool is_worn(const InstanceSlot& slot) { return slot.generation == 0; }

/// Returns a free slot, now alive and without a place in the tree, or no_child if there is none.
inline std::uint32_t take_slot(SceneBlock& block) {
    BlockHead& head = *block.head;
    std::uint32_t number = head.free_slot;
    if (number != no_child) {
        head.free_slot = block.slots[number].place;
    } else {
        if (head.slots_used == head.slot_capacity) return no_child;
        number = head.slots_used++;
        block.slots[number] = InstanceSlot{};
    }
    ++block.slots[number].generation;
    ++head.live;
    return number;
}
/// Ends the life of a slot, which is no longer in the tree.
inline void give_back_slot(SceneBlock& block, std::uint32_t number) {
    BlockHead& head = *block.head;
    InstanceSlot& slot = block.slots[number];
    ++slot.generation;
    --head.live;
    if (is_worn(slot)) return;
    slot.place = head.free_slot;
    head.free_slot = number;
}

}  // namespace espalier::detail
