// Pairs of instances whose boxes touch, sorted, in pages.
#pragma once

#include <span>

#include <espalier/scenes/pairs.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/box_tree/self_join.hpp>

namespace espalier::detail {

/// Returns whether a pair of live slots counts, for the masks and the filter.
inline bool is_selected(const SceneBlock& block, const PairFilter& filter, const InstancePair& pair) {
    if ((block.slots[pair.a].mask & block.slots[pair.b].mask) == 0) return false;
    return !filter.keep || filter.keep(InstanceId{pair.a}, InstanceId{pair.b});
}

/// Writes the selected pairs of touching boxes from `from` on, in ascending order, as many as there is room for.
FilledPairs<InstancePair> collect_touching_pairs(SceneBlock& block, std::span<InstancePair> out,
                                                 const PairFilter& filter, InstancePair from,
                                                 SelfJoin join = for_each_pair);

}  // namespace espalier::detail
