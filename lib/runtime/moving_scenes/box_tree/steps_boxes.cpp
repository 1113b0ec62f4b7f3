#include <runtime/moving_scenes/box_tree/steps_boxes.hpp>

#include <runtime/transforms/rotation.hpp>

namespace espalier::detail::scalar {

bool find_steps_boxes(const EightPlaces& places, std::int32_t step_exponent, EightStepsBoxes& boxes) {
    for (unsigned i = 0; i < EightStepsBoxes::count; ++i) {
        const Transform& transform = *places.transforms[i];
        StepsBox box;
        if (!is_in_range(transform.scale) || !find_steps_box(*places.parts[i], transform, step_exponent, box))
            return false;
        for (int k = 0; k < 3; ++k) {
            boxes.low[k][i] = box.low[k];
            boxes.negative_high[k][i] = -box.high[k];
        }
    }
    return true;
}

}  // namespace espalier::detail::scalar
