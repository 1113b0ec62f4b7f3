// The slots of instances: which are alive, which is next.
#pragma once

#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

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
