// The tree of a moving scene, as the walks of queries take it.
#pragma once

#include <espalier/scenes/moving_scene.hpp>
#include <runtime/moving_scenes/access.hpp>
#include <runtime/scenes/instance_walk.hpp>

namespace espalier::detail {

/// A lattice point at or below a coordinate of a box that is exact as a float: the origin of a tree.
constexpr std::int32_t lattice_point_below(std::int32_t steps) { return steps & ~127; }
constexpr std::int32_t lattice_point_above(std::int32_t steps) { return (steps + 127) & ~127; }

/// The tree of a moving scene as its walks take it: its boxes are counted from the lattice point at its low corner.
struct MovingTree {
    const SceneData& scene;
    SceneBlock block;
    std::int32_t origin[3];

    explicit MovingTree(const SceneData& seen) : scene(seen), block(parts_of(seen.block)) {
        const StepsBox all = block.node(block.head->root).bounds();
        for (int k = 0; k < 3; ++k) origin[k] = lattice_point_below(all.low[k]);
    }

    /// Passes an instance to an answer if its mask and its box are selected.
    Visit take(std::uint32_t number, AnyInstanceAnswer& answer) const {
        if ((block.masks[number] & answer.mask) == 0) return Visit::next;
        const InstanceSlot& slot = block.slots[number];
        if (answer.meeting != nullptr && !answer.meeting->meets([&](int k) { return slot.box.low[k] - origin[k]; },
                                                                [&](int k) { return slot.box.high[k] - origin[k]; }))
            return Visit::next;
        const std::int32_t exponent = scene.tree.step_exponent;
        return answer.visit({part_of(scene, slot.mesh),
                             {number},
                             seen_transform(slot, scene.origin, exponent),
                             is_rounded_in(slot, scene.origin, exponent)},
                            answer.limit);
    }
};

}  // namespace espalier::detail
