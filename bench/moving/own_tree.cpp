#include "own_tree.hpp"

#include <cmath>
#include <vector>

#include <runtime/moving_scenes/box_tree/slots.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::bench {

using detail::BoxNode;

namespace {

/// Returns a bit for each child of each node: whether an instance in it was moved in that step, or all bits.
std::vector<std::uint8_t> marks_of(const detail::SceneBlock& block, std::optional<std::uint32_t> moved_in) {
    std::vector<std::uint8_t> marks(block.head->nodes_used, moved_in ? 0 : 0xFF);
    for (std::uint32_t slot = 0; moved_in && slot < block.head->slots_used; ++slot) {
        if (!detail::is_live(block.slots[slot]) || block.moved[slot] != *moved_in) continue;
        for (std::uint32_t at = block.slots[slot].place; at != detail::no_child; at = block.parent[at / 8])
            marks[at / 8] = static_cast<std::uint8_t>(marks[at / 8] | 1u << at % 8);
    }
    return marks;
}

}  // namespace

TreeShape shape_of(const detail::SceneBlock& block, int step_exponent) {
    const detail::BlockHead& head = *block.head;
    TreeShape shape;
    shape.area = std::ldexp(static_cast<double>(detail::area_of_boxes(block)), 2 * step_exponent);
    shape.nodes = head.nodes_used - head.free_nodes;
    shape.fill = static_cast<double>(head.live + shape.nodes - 1) / static_cast<double>(shape.nodes);
    shape.depth = head.levels;
    return shape;
}

std::size_t count_node_pairs(const detail::SceneBlock& block, std::optional<std::uint32_t> moved_in) {
    struct Pair {
        std::uint32_t a, b, level;
    };
    if (block.head->levels == 0) return 0;
    const std::vector<std::uint8_t> marks = marks_of(block, moved_in);
    std::vector<Pair> waiting = {{block.head->root, block.head->root, block.head->levels - 1u}};
    std::size_t count = 0;
    while (!waiting.empty()) {
        const Pair pair = waiting.back();
        waiting.pop_back();
        ++count;
        if (pair.level == 0) continue;
        const BoxNode &a = block.node(pair.a), &b = block.node(pair.b);
        for (unsigned i = 0; i < BoxNode::most; ++i)
            for (unsigned j = pair.a == pair.b ? i : 0; j < BoxNode::most; ++j)
                if (touch(a.box(i), b.box(j)) && ((marks[pair.a] >> i | marks[pair.b] >> j) & 1) != 0)
                    waiting.push_back({a.child[i], b.child[j], pair.level - 1});
    }
    return count;
}

}  // namespace espalier::bench
