// The box of a shape on the lattice of a scene, which selects the same instances on every machine.
#pragma once

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/scenes/instances.hpp>
#include <runtime/scenes/shape_bounds.hpp>

namespace espalier::detail {

/// A box that stays where it is, widened by more than any query of an instance may move it by rounding. Its test is
/// scalar: what the lanes of a walk pass on depends on the instruction set.
class BoxInSteps {
public:
    BoxInSteps(const SceneData& scene, const ShapeBounds& bounds) {
        const SceneAround around = scene_around(scene, bounds);
        const std::int32_t step_exponent = scene.tree.step_exponent;
        const float low[3] = {bounds.low.x, bounds.low.y, bounds.low.z};
        const float high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
        for (int k = 0; k < 3; ++k) {
            low_[k] = scale_by_power_of_two(low[k] - around.offset[k] - around.slack, -step_exponent);
            high_[k] = scale_by_power_of_two(high[k] - around.offset[k] + around.slack, -step_exponent);
        }
    }

    /// Returns whether the box meets that of an instance in its node.
    [[nodiscard]] bool meets_box_of(const InstancePlace& place) const {
        const unsigned child = place.node.node_children() + place.number;
        return meets([&](int k) { return place.node.low(k, child, format::scene::bits); },
                     [&](int k) { return place.node.high(k, child, format::scene::bits); });
    }
    /// Returns whether the box meets one whose planes low(k) and high(k) are steps of the scene's lattice.
    template <class Low, class High>
    [[nodiscard]] bool meets(Low low, High high) const {
        for (int k = 0; k < 3; ++k) {
            if (static_cast<float>(low(k)) > high_[k]) return false;
            if (static_cast<float>(high(k)) < low_[k]) return false;
        }
        return true;
    }

private:
    float low_[3];   ///< in steps
    float high_[3];  ///< in steps
};

/// Returns bounds that are wider by the slack of a scene, so that a walk with them passes on every instance that the
/// narrower ones select, however its lanes round.
inline ShapeBounds widened(const SceneData& scene, const ShapeBounds& bounds) {
    const float slack = scene_around(scene, bounds).slack;
    ShapeBounds wide = bounds;
    wide.low = {bounds.low.x - slack, bounds.low.y - slack, bounds.low.z - slack};
    wide.high = {bounds.high.x + slack, bounds.high.y + slack, bounds.high.z + slack};
    return wide;
}

}  // namespace espalier::detail
