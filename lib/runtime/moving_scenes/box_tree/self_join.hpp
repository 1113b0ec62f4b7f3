// All pairs of instances whose boxes touch: the tree, or some of its instances, against the tree itself.
#pragma once

#include <espalier/scenes/pairs.hpp>
#include <espalier/scenes/statistics.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// A visitor of some pairs of slots whose boxes touch, with either slot first.
using OnTouchingBoxes = FunctionRef<void(std::span<const InstancePair>)>;

/// The slots whose boxes are compared with the tree.
enum class JoinedSlots : std::uint8_t {
    all,    ///< each pair is visited once
    moved,  ///< those that were moved or inserted since the last step ended, with each other slot that they touch
    one,    ///< with each other slot that it touches
};

/// A walk that visits pairs of slots whose boxes touch, in an order that follows the tree. The number of a slot counts
/// only for JoinedSlots::one, and is that of a live one; it is visited as the first of each pair.
using SelfJoin =
    FunctionRef<void(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot, const OnTouchingBoxes& visit)>;

/// The walk of SelfJoin, by the best instruction set of this machine.
void join_by_best_set(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot, const OnTouchingBoxes& visit);

/// Walks as join_by_best_set() does, without lanes, and adds the work to counters.
void count_join(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot, const OnTouchingBoxes& visit,
                SceneCounters& counters);

}  // namespace espalier::detail
