// The closest point of all instances of a scene.
#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/scenes/shape_bounds.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {

using namespace detail;

namespace {

/// The space around a point, in steps of the scene's lattice.
class Surroundings {
public:
    Surroundings(const SceneData& scene, const Vec3& point) : step_exponent_(scene.tree.step_exponent) {
        const SceneAround around = scene_around(scene, {point, {}, {}});
        const float reach = steps(around.reach);
        slack_ = 2.0f * steps(around.slack);
        meets_all_ = !(reach < farthest_reach);
        for (int k = 0; k < 3; ++k) point_.steps[k] = meets_all_ ? 0.0f : -steps(around.offset[k]);
    }

    /// Returns the largest squared distance of a box that may hold something as near.
    [[nodiscard]] float key_of(float distance) const {
        const float most = steps(limit_above(distance)) + slack_;
        return meets_all_ ? infinity : most * most * (1.0f + 0x1p-20f);
    }
    [[nodiscard]] const RoundedPoint& point() const { return point_; }

private:
    [[nodiscard]] float steps(float length) const { return scale_by_power_of_two(length, -step_exponent_); }

    RoundedPoint point_{};
    std::int32_t step_exponent_;
    float slack_;
    bool meets_all_;
};

}  // namespace

InScene<ClosestPoint> closest_point(const SceneView& scene, Vec3 point, float max_distance,
                                    std::uint32_t mask) noexcept {
    const bool is_sound = is_finite(point) && is_radius(max_distance);
    BestInScene<ClosestPoint> best(!scene     ? refusal_of(scene)
                                   : is_sound ? QueryStatus::not_found
                                              : QueryStatus::invalid_argument);
    if (is_refused(best->status)) return best.result();
    const SceneData& data = data_of(scene);
    const Surroundings surroundings(data, point);
    const auto approach = [&](const VisitedInstance& instance, float& limit) {
        const float scale = instance.transform.scale;
        // Numbers below 2^-100 count as zero, but not in the limit that the best result sets.
        float most = without_tiny(without_tiny(max_distance) / scale);
        if (best) most = minimum(maximum(limit_above(best->distance) / scale, 0x1p-99f), most);
        const Vec3 local = to_local(instance.transform, point);
        InScene<ClosestPoint> nearest = instance.mesh != nullptr ? in_tile(closest_point(*instance.mesh, local, most))
                                                                 : closest_point(*instance.tile, local, most, mask);
        nearest.hit.distance = without_tiny(without_tiny(nearest->distance) * scale);
        if (!best.is_better(*nearest, instance.id_of(nearest.instance), &ClosestPoint::distance)) return Visit::next;
        nearest.hit.point = to_world(instance.transform, nearest->point);
        nearest.hit.on_shape = point;
        nearest.hit.face_normal = normal_to_world(instance.transform, nearest->face_normal);
        best.set(*nearest, instance.id_of(nearest.instance));
        limit = surroundings.key_of(nearest->distance);
        return Visit::next;
    };
    visit_nearest_instances(data, mask, surroundings.point(), surroundings.key_of(max_distance), approach);
    return best.result();
}

}  // namespace espalier
