// The tree over moving instances: an R-tree (Guttman 1984) whose leaf nodes are all at one depth.
#pragma once

#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// Inserts the box of a live slot that is not in the tree; repacks the tree where nodes might run out.
void insert_box(SceneBlock& block, std::uint32_t slot);
/// Removes the box of a slot.
void remove_box(SceneBlock& block, std::uint32_t slot);
/// Sets the box of a slot in its leaf node and in the boxes above.
void update_box(SceneBlock& block, std::uint32_t slot);
/// Sets the box of a slot in its leaf node alone: refit_boxes() must follow.
void set_box(SceneBlock& block, std::uint32_t slot);
/// Renews the boxes of all nodes above those that set_box() changed, each once. Returns the number of nodes.
std::uint32_t refit_boxes(SceneBlock& block);
/// Builds the tree anew in Hilbert order. The tree is then a function of the live slots and their boxes.
void repack_boxes(SceneBlock& block);
/// Returns the sum of the areas of all boxes in the tree for each instance, in square steps.
float area_of_boxes(const SceneBlock& block);

/// Puts a child of a node of that level into a place of it.
inline void put_child(SceneBlock& block, std::uint32_t level, std::uint32_t node, unsigned place, const StepsBox& box,
                      std::uint32_t child) {
    block.node(node).set(place, box, child);
    const std::uint32_t at = 8 * node + place;
    if (level == 0) block.slots[child].place = at;
    else block.parent[child] = at;
}
/// Returns a node that is not in use, without children.
inline std::uint32_t take_node(SceneBlock& block) {
    BlockHead& head = *block.head;
    const std::uint32_t number = head.free_node != no_child ? head.free_node : head.nodes_used++;
    if (head.free_node != no_child) {
        head.free_node = block.node(number).child[0];
        --head.free_nodes;
    }
    block.node(number).clear();
    block.parent[number] = no_child;
    block.dirty[number] = 0;
    return number;
}
inline void give_back_node(SceneBlock& block, std::uint32_t number) {
    BlockHead& head = *block.head;
    block.node(number).clear();
    block.node(number).child[0] = head.free_node;
    block.parent[number] = no_child;
    block.dirty[number] = 0;
    head.free_node = number;
    ++head.free_nodes;
}
/// Renews the boxes of a node's ancestors, as far as they change.
inline void renew_ancestors(SceneBlock& block, std::uint32_t node) {
    while (block.parent[node] != no_child) {
        const std::uint32_t above = block.parent[node];
        const StepsBox box = block.node(node).bounds();
        if (block.node(above / 8).box(above % 8) == box) return;
        block.node(above / 8).set_box(above % 8, box);
        node = above / 8;
    }
}

}  // namespace espalier::detail
