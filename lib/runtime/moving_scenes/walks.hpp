// The walks over the tree of a moving scene: the instances whose boxes a passage meets, or that are near a point.
#ifndef ESPALIER_MOVING_SCENES_WALKS_HPP
#define ESPALIER_MOVING_SCENES_WALKS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/moving_scenes/access.hpp>
#include <runtime/proximity/point_nodes.hpp>
#include <runtime/scenes/instance_walk.hpp>

ESPALIER_BEGIN_SET

#if ESPALIER_LANES == 16

// A node has eight children.
using avx2::moving_instances_in_order;
using avx2::moving_instances_nearest_first;

#else

namespace {

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

/// Returns planes of children as floats, counted from the origin of the tree. Those of places without a child are of no
/// meaning.
ESPALIER_ALWAYS_INLINE inline Floats planes_from(const std::int32_t* planes, std::int32_t origin) {
    return to_floats(load_as<Ints>(planes) - static_cast<std::uint32_t>(origin));
}

/// Returns which places of a node have a child, a bit for each.
inline unsigned children_of(const BoxNode& node) {
    unsigned mask = 0;
    for (unsigned i = 0; i < BoxNode::most; ++i) mask |= (node.child[i] != no_child ? 1u : 0u) << i;
    return mask;
}

/// Returns the children whose boxes the passage meets up to a limit, and where each begins.
ESPALIER_ALWAYS_INLINE inline unsigned near_children(const BoxNode& node, const MovingTree& tree,
                                                     const Passage& passage, float limit, float* keys) {
    unsigned mask = 0;
    for (unsigned first = 0; first < BoxNode::most; first += lanes) {
        Floats enter = splat(0.0f), leave = splat(limit);
        for (int k = 0; k < 3; ++k) {
            const Floats inverse = splat(passage.inverse(k));
            const Floats low = planes_from(&node.low[k][first], tree.origin[k]);
            const Floats high = planes_from(&node.high[k][first], tree.origin[k]);
            const bool is_forward = passage.inverse(k) >= 0.0f;
            enter = larger(multiply_add(is_forward ? low : high, inverse, splat(passage.near_offset(k))), enter);
            leave = smaller(multiply_add(is_forward ? high : low, inverse, splat(passage.far_offset(k))), leave);
        }
        mask |= at_most(enter, leave) << first;
        store(keys + first, enter);
    }
    return mask & (children_of)(node);
}

/// Returns the children whose boxes are within the squared limit of a point, and the squared distance of each.
ESPALIER_ALWAYS_INLINE inline unsigned near_children(const BoxNode& node, const MovingTree& tree,
                                                     const RoundedPoint& point, float limit, float* keys) {
    unsigned mask = 0;
    for (unsigned first = 0; first < BoxNode::most; first += lanes) {
        Floats low[3], high[3];
        for (int k = 0; k < 3; ++k) {
            const Floats from = splat(point.steps[k]);
            low[k] = subtract(planes_from(&node.low[k][first], tree.origin[k]), from);
            high[k] = subtract(planes_from(&node.high[k][first], tree.origin[k]), from);
        }
        const Floats distance = squared_distance(low, high);
        mask |= at_most(distance, splat(limit)) << first;
        store(keys + first, distance);
    }
    return mask & (children_of)(node);
}

/// What waits to be visited: a node, or an instance at level 0.
struct WaitingBox {
    float key;
    std::uint32_t number;  ///< 16 * child + level
};

/// Visits the instances near a region, the nearest first.
template <class Region>
void moving_instances_nearest_first(const Region& region, AnyInstanceAnswer& answer) {
    const MovingTree tree(answer.scene);
    const BlockHead& head = *tree.block.head;
    WaitingBox waiting[most_tree_levels * (BoxNode::most - 1) + 1];
    alignas(32) float keys[BoxNode::most];
    unsigned size = 1;
    waiting[0] = {0.0f, 16 * head.root + head.levels};
    while (size != 0) {
        const WaitingBox nearest = waiting[--size];
        // By their bits, which order numbers that are not negative.
        if (magnitude_bits(nearest.key) > magnitude_bits(answer.limit)) continue;
        const std::uint32_t level = nearest.number % 16, number = nearest.number / 16;
        if (level == 0) {
            if (tree.take(number, answer) == Visit::stop) return;
            continue;
        }
        const BoxNode& node = tree.block.node(number);
        const unsigned first = size;
        for (unsigned mask = (near_children)(node, tree, region, answer.limit, keys); mask != 0; mask &= mask - 1) {
            const auto place = static_cast<unsigned>(std::countr_zero(mask));
            // The nearest is on top; of equally near ones the first.
            unsigned at = size++;
            for (; at > first && magnitude_bits(waiting[at - 1].key) <= magnitude_bits(keys[place]); --at)
                waiting[at] = waiting[at - 1];
            waiting[at] = {keys[place], 16 * node.child[place] + (level - 1)};
        }
    }
}

}  // namespace

ESPALIER_QUERY_OF_SET Visit moving_instances_in_order(const Passage& passage, AnyInstanceAnswer& answer) {
    const MovingTree tree(answer.scene);
    const BlockHead& head = *tree.block.head;
    struct Level {
        std::uint32_t node;
        unsigned waiting;  ///< children that are still to be visited
    };
    Level path[most_tree_levels];
    alignas(32) float keys[BoxNode::most];
    const auto level_of = [&](std::uint32_t node) {
        return Level{node, (near_children)(tree.block.node(node), tree, passage, answer.limit, keys)};
    };
    unsigned depth = 0;
    path[0] = level_of(head.root);
    for (;;) {
        Level& top = path[depth];
        if (top.waiting == 0) {
            if (depth == 0) return Visit::next;
            --depth;
            continue;
        }
        const std::uint32_t child = tree.block.node(top.node).child[std::countr_zero(top.waiting)];
        top.waiting &= top.waiting - 1;
        if (depth + 1u == head.levels) {
            if (tree.take(child, answer) == Visit::stop) return Visit::stop;
        } else {
            path[++depth] = level_of(child);
        }
    }
}

#endif

ESPALIER_END_SET

#endif
