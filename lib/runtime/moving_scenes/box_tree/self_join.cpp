#include <runtime/moving_scenes/box_tree/self_join.hpp>

#define ESPALIER_FRAGMENT <runtime/moving_scenes/box_tree/join_walk.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier::detail {

void join_by_best_set(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot, const OnTouchingBoxes& visit) {
    ESPALIER_DISPATCH(join, block, joined, slot, visit);
}

void count_join(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot, const OnTouchingBoxes& visit,
                SceneCounters& counters) {
    scalar::join_counting(block, joined, slot, visit, scalar::Counted{&counters});
}

}  // namespace espalier::detail
