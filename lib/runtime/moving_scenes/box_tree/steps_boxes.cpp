#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#define ESPALIER_FRAGMENT <runtime/moving_scenes/box_tree/boxes_in_lanes.hpp>
#include <runtime/lanes/for_each_set.hpp>

namespace espalier::detail {

bool find_steps_boxes_by_best_set(const EightPlaces& places, std::int32_t step_exponent, EightStepsBoxes& boxes) {
    return ESPALIER_DISPATCH(find_steps_boxes, places, step_exponent, boxes);
}

}  // namespace espalier::detail
