// All pairs of instances whose boxes touch: the tree, or some of its instances, against the tree itself.
#pragma once

#include <espalier/function_ref.hpp>
#include <espalier/scenes/statistics.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// A visitor of two slots whose boxes touch, in either order.
using OnTouchingBoxes = FunctionRef<void(std::uint32_t, std::uint32_t)>;

#define ESPALIER_DECLARE_SELF_JOIN(instruction_set)                                  \
    namespace instruction_set {                                                      \
    void join_with_itself(const SceneBlock& block, const OnTouchingBoxes& visit);    \
    void join_moved_with_all(const SceneBlock& block, const OnTouchingBoxes& visit); \
    }
ESPALIER_FOR_SETS_WITH_PAIRS(ESPALIER_DECLARE_SELF_JOIN)
#undef ESPALIER_DECLARE_SELF_JOIN
#if ESPALIER_X86 && defined(__x86_64__)
namespace avx512 {
using avx2::join_moved_with_all;  // a node has eight children
using avx2::join_with_itself;
}  // namespace avx512
#endif

/// Visits each pair of slots whose boxes touch, each pair once, in an order that follows the tree.
inline void for_each_touching_pair(const SceneBlock& block, const OnTouchingBoxes& visit) {
    ESPALIER_DISPATCH(join_with_itself, block, visit);
}

/// Visits each slot that has moved since the last step ended, with each other slot whose box touches its box.
inline void for_each_pair_of_moved(const SceneBlock& block, const OnTouchingBoxes& visit) {
    ESPALIER_DISPATCH(join_moved_with_all, block, visit);
}

/// A choice of the two: the pairs of slots that have moved, or all pairs.
using SelfJoin = FunctionRef<void(const SceneBlock& block, bool of_moved, const OnTouchingBoxes& visit)>;

inline void for_each_pair(const SceneBlock& block, bool of_moved, const OnTouchingBoxes& visit) {
    if (of_moved) for_each_pair_of_moved(block, visit);
    else for_each_touching_pair(block, visit);
}

namespace scalar {
// The same two walks, which add their work to counters. That of all pairs is that of machines that are not small.
void count_join_with_itself(const SceneBlock& block, const OnTouchingBoxes& visit, SceneCounters& counters);
void count_join_moved_with_all(const SceneBlock& block, const OnTouchingBoxes& visit, SceneCounters& counters);
}  // namespace scalar

}  // namespace espalier::detail
