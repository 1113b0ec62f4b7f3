// New boxes of instances in the tree as it is, and how much surface its boxes have.
#include <runtime/base/bits.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::detail {

void set_box(SceneBlock& block, std::uint32_t slot) {
    const std::uint32_t place = block.slots[slot].place;
    block.node(place / 8).set_box(place % 8, block.slots[slot].box);
    block.dirty[place / 8] = 1;
}

void update_box(SceneBlock& block, std::uint32_t slot) {
    const std::uint32_t place = block.slots[slot].place;
    block.node(place / 8).set_box(place % 8, block.slots[slot].box);
    renew_ancestors(block, place / 8);
}

std::uint32_t refit_boxes(SceneBlock& block) {
    const BlockHead& head = *block.head;
    // Nodes of one level after those of the level below: all leaf nodes are at one depth, so a path has a length.
    struct Level {
        std::uint32_t node;
        std::uint32_t next;  ///< the place that is visited next
        bool is_dirty;
    };
    if (head.levels == 0) return 0;
    Level path[most_tree_levels];
    std::uint32_t depth = 0, renewed = 0;
    path[0] = {head.root, 0, false};
    for (;;) {
        Level& top = path[depth];
        const bool is_leaf = depth + 1 == head.levels;
        while (!is_leaf && top.next < BoxNode::most && block.node(top.node).child[top.next] == no_child) ++top.next;
        if (!is_leaf && top.next < BoxNode::most) {
            path[++depth] = {block.node(top.node).child[top.next++], 0, false};
            continue;
        }
        const std::uint32_t node = top.node;
        const bool is_dirty = top.is_dirty || block.dirty[node] != 0;
        block.dirty[node] = 0;
        if (depth == 0) return renewed;
        --depth;
        if (!is_dirty) continue;
        const std::uint32_t above = block.parent[node];
        block.node(above / 8).set_box(above % 8, block.node(node).bounds());
        path[depth].is_dirty = true;
        ++renewed;
    }
}

float area_of_boxes(const SceneBlock& block) {
    const BlockHead& head = *block.head;
    if (head.live == 0) return 0.0f;
    // No box is larger than the root's, so that the sum of all boxes fits: there are fewer than 2^25.
    unsigned shift = 0;
    while (block.node(head.root).bounds().half_area() >> shift >= std::int64_t{1} << 38) ++shift;
    std::int64_t sum = 0;
    for (std::uint32_t number = 0; number < head.nodes_used; ++number) {
        const BoxNode& node = block.node(number);
        const bool is_free = block.parent[number] == no_child && number != head.root;
        for (unsigned i = 0; !is_free && i < BoxNode::most; ++i)
            if (node.child[i] != no_child) sum += node.box(i).half_area() >> shift;
    }
    return scale_by_power_of_two(static_cast<float>(sum) / static_cast<float>(head.live), static_cast<int>(shift));
}

}  // namespace espalier::detail
