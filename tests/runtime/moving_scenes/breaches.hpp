// Rules of a block of a moving scene, and edits that break them.
#pragma once

#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "made_bytes.hpp"

namespace espalier::tests {

/// A rule and what breaks it.
struct Breach {
    std::string rule;
    std::function<void(EditedBlock&)> edit;
};

/// Checks that the bytes open, and that they do not after any of the edits.
inline void check_breaches(std::span<const std::byte> bytes, const std::vector<Breach>& breaches) {
    REQUIRE(EditedBlock(bytes).opens());
    for (const Breach& breach : breaches) {
        CAPTURE(breach.rule);
        EditedBlock edited(bytes);
        breach.edit(edited);
        CHECK_FALSE(edited.opens());
    }
}

/// A scene of three levels with free slots and free nodes; `must_refit` if one of its instances has been moved.
inline std::vector<std::byte> large_scene(bool must_refit = false) { return make_bytes(80, 78, must_refit); }

/// Returns the leaf node of the second slot, which is alive.
inline std::uint32_t leaf_of(const detail::SceneBlock& block) { return block.slots[1].place / 8; }

/// Takes a slot out of the tree, and renews the boxes above as if no node needed more children.
inline void drop_slot(detail::SceneBlock& block, std::uint32_t slot) {
    const std::uint32_t place = block.slots[slot].place;
    block.node(place / 8).drop(place % 8);
    detail::renew_ancestors(block, place / 8);
}

inline std::uint32_t last_free_node(const detail::SceneBlock& block) {
    std::uint32_t node = block.head->free_node;
    while (block.node(node).child[0] != detail::no_child) node = block.node(node).child[0];
    return node;
}

}  // namespace espalier::tests
