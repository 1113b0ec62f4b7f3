// The boxes of instances in the tree: set, updated and refitted, and how much surface they have.
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
    std::uint32_t renewed = 0;
    // Nodes of one level after those of the level below. A node that waits is marked with its level and 1.
    for (std::uint32_t level = 1; level <= head.levels; ++level)
        for (std::uint32_t node = 0; node < head.nodes_used; ++node) {
            if (block.dirty[node] != level) continue;
            block.dirty[node] = 0;
            const std::uint32_t above = block.parent[node];
            if (above == no_child) continue;
            block.node(above / 8).set_box(above % 8, block.node(node).bounds());
            block.dirty[above / 8] = static_cast<std::uint8_t>(level + 1);
            ++renewed;
        }
    return renewed;
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
