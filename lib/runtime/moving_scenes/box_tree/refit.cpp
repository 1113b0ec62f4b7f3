// New boxes of instances in the tree as it is, and how much surface its boxes have.
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
    float sum = 0.0f;
    for (std::uint32_t number = 0; number < head.nodes_used; ++number) {
        if (block.parent[number] == no_child && number != head.root) continue;
        const BoxNode& node = block.node(number);
        float of_node = 0.0f;
        for (unsigned i = 0; i < BoxNode::most; ++i)
            if (node.child[i] != no_child) of_node += node.box(i).half_area();
        sum += of_node;
    }
    return sum / static_cast<float>(head.live);
}

}  // namespace espalier::detail
