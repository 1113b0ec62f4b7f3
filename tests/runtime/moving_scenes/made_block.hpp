// A moving scene's block for tests, with the operations on instances that are only boxes.
#pragma once

#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "support/machine/aligned_buffer.hpp"

namespace espalier::tests {

/// A block for so many instances, by default with nodes for any order of insertions. Copies have the same bytes
/// elsewhere.
class MadeBlock {
public:
    explicit MadeBlock(std::uint32_t capacity) : MadeBlock(capacity, detail::most_nodes_of(capacity)) {}
    MadeBlock(std::uint32_t capacity, std::uint32_t nodes)
        : memory_(static_cast<std::size_t>(detail::block_bytes(capacity, nodes))),
          block(detail::make_block(bytes(), capacity, nodes, -16)) {}
    MadeBlock(const MadeBlock& other) : memory_(other.memory_.bytes()), block(detail::parts_of(bytes())) {}
    MadeBlock& operator=(const MadeBlock&) = delete;
    ~MadeBlock() = default;

    std::uint32_t insert(const detail::StepsBox& box) {
        const std::uint32_t slot = detail::take_slot(block);
        block.slots[slot].transform = {};
        block.masks[slot] = 0xFFFFFFFF;
        block.slots[slot].box = box;
        detail::insert_box(block, slot);
        return slot;
    }
    void remove(std::uint32_t slot) {
        detail::remove_box(block, slot);
        detail::give_back_slot(block, slot);
    }
    std::byte* bytes() { return memory_.bytes().data(); }
    [[nodiscard]] std::size_t size() const { return memory_.bytes().size(); }

private:
    AlignedBuffer memory_;

public:
    detail::SceneBlock block;
};

/// A cube of 2^4 to 2^20 steps, or a flat or long box, anywhere in a region.
inline detail::StepsBox random_box(Random& random, std::int32_t region) {
    const std::int32_t size = 1 << random.between(4, 20);
    detail::StepsBox box{};
    for (int k = 0; k < 3; ++k) {
        box.low[k] = random.between(-region, region - 1);
        box.high[k] = box.low[k] + (random.below(8) == 0 ? 0 : size);
    }
    return box;
}

/// Returns whether two boxes share a point.
constexpr bool touch(const detail::StepsBox& a, const detail::StepsBox& b) {
    for (int k = 0; k < 3; ++k)
        if (a.low[k] > b.high[k] || b.low[k] > a.high[k]) return false;
    return true;
}

/// The pairs of live slots whose boxes touch, by a loop.
inline std::vector<InstancePair> loop_over_slots(const detail::SceneBlock& block) {
    std::vector<InstancePair> pairs;
    for (std::uint32_t a = 0; a < block.head->slots_used; ++a)
        for (std::uint32_t b = a + 1; b < block.head->slots_used; ++b)
            if (is_live(block.slots[a]) && is_live(block.slots[b]) && touch(block.slots[a].box, block.slots[b].box))
                pairs.push_back({a, b});
    return pairs;
}

}  // namespace espalier::tests
