#include "own_tree.hpp"

#include <cmath>

#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::bench {

TreeShape shape_of(const detail::SceneBlock& block, int step_exponent) {
    const detail::BlockHead& head = *block.head;
    TreeShape shape;
    shape.area = std::ldexp(static_cast<double>(detail::area_of_boxes(block)), 2 * step_exponent);
    shape.nodes = head.nodes_used - head.free_nodes;
    shape.fill = static_cast<double>(head.live + shape.nodes - 1) / static_cast<double>(shape.nodes);
    shape.depth = head.levels;
    return shape;
}

std::uint64_t count_box_tests(const detail::SceneBlock& block, bool only_moved) {
    detail::BlockHead head = *block.head;
    --head.step;
    detail::SceneBlock last_step = block;
    last_step.head = &head;
    SceneCounters counters;
    const auto ignore = [](std::span<const InstancePair>) {};
    const detail::JoinedSlots joined = only_moved ? detail::JoinedSlots::moved : detail::JoinedSlots::all;
    detail::scalar::count_join(last_step, joined, 0, ignore, counters);
    return counters.box_tests;
}

}  // namespace espalier::bench
