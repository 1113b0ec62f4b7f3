// Boxes of many instances in whole steps of a world, eight at a time.
#pragma once

#include <runtime/moving_scenes/box_tree/steps_box.hpp>

namespace espalier::detail {

/// The boxes of eight instances, coordinate by coordinate.
struct EightStepsBoxes {
    static constexpr unsigned count = 8;

    alignas(32) std::int32_t low[3][count];
    alignas(32) std::int32_t negative_high[3][count];

    [[nodiscard]] StepsBox operator[](unsigned i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {-negative_high[0][i], -negative_high[1][i], -negative_high[2][i]}};
    }
};

/// Eight parts, and the place of each.
struct EightPlaces {
    const PartBounds* parts[EightStepsBoxes::count];
    const Transform* transforms[EightStepsBoxes::count];
};

/// Finds the boxes of eight instances with the bits of find_steps_box(), by the best instruction set of this machine.
/// Returns false, with boxes of no meaning, if one has no box or a scale or a rotation that is far from 1: then each
/// has to be found alone.
bool find_steps_boxes_by_best_set(const EightPlaces& places, std::int32_t step_exponent, EightStepsBoxes& boxes);

}  // namespace espalier::detail
