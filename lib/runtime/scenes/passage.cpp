#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/passage.hpp>

#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

/// Along an axis with a smaller part of the scaled displacement a box stays: its way there is less than the slack.
constexpr float least_way = 0x1p-60f;

}  // namespace

Passage::Passage(const SceneData& scene, const ShapeBounds& bounds) : Passage(scene, bounds, {}, 0.0f) {}

Passage::Passage(const SceneData& scene, const ShapeBounds& bounds, const Vec3& displacement, float magnitude) {
    const SceneAround around = scene_around(scene, bounds, magnitude);
    const std::int32_t step_exponent = scene.tree.step_exponent;
    const float low[3] = {bounds.low.x, bounds.low.y, bounds.low.z};
    const float high[3] = {bounds.high.x, bounds.high.y, bounds.high.z};
    // to_local() takes parts below 2^-100 for zero.
    const float way[3] = {without_tiny(displacement.x), without_tiny(displacement.y), without_tiny(displacement.z)};
    std::uint32_t longest = 0;
    for (int k = 0; k < 3; ++k) longest = magnitude_bits(way[k]) > longest ? magnitude_bits(way[k]) : longest;
    const int way_exponent = longest != 0 ? exponent_of_bits(longest) : 0;
    t_exponent_ = way_exponent - step_exponent;
    const auto steps = [&](float length) { return scale_by_power_of_two(length, -step_exponent); };
    const bool meets_all = !(steps(around.reach) < farthest_reach);
    for (int k = 0; k < 3; ++k) {
        const float scaled = scale_by_power_of_two(way[k], -way_exponent);
        // The slab tests of some instruction sets scale the inverse by its exponent: it is never 0.
        inverse_[k] = 1.0f / (absolute(scaled) < least_way ? least_way : scaled);
        // Up to coordinate 0: by how much the box is below it at first, and how far it can go before it is above.
        const float below = steps(around.offset[k] - around.slack - high[k]);
        const float room = steps(around.offset[k] + around.slack - low[k]);
        near_offset_[k] = meets_all ? -infinity : (inverse_[k] < 0.0f ? room : below) * inverse_[k];
        far_offset_[k] = meets_all ? infinity : (inverse_[k] < 0.0f ? below : room) * inverse_[k];
    }
}

float Passage::key_of(float t) const { return scale_by_power_of_two(t, t_exponent_) + 0.0f; }

Visit visit_meeting(const SceneView& scene, const ShapeBounds& bounds, std::uint32_t mask,
                    const InstanceVisitor& visit) {
    const SceneData& data = data_of(scene);
    const BoxInSteps box(data, bounds);
    return visit_instances(data, mask, Passage(data, widened(data, bounds)), 0.0f, visit, &box);
}

}  // namespace espalier::detail
