#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#include <runtime/blob/deformable_blob.hpp>
#include <runtime/moving_scenes/box_tree/ends_around.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

PartBounds bounds_of(const BlobData& mesh) {
    const float step = power_of_two(mesh.step_exponent);
    PartBounds bounds = {{}, {}, step, 0.0f, 1.0f};
    const PoseBounds pose = pose_bounds_of(mesh);
    float* const center[3] = {&bounds.center.x, &bounds.center.y, &bounds.center.z};
    float* const half[3] = {&bounds.half.x, &bounds.half.y, &bounds.half.z};
    float sizes[3];
    for (int k = 0; k < 3; ++k) {
        // Exact numbers of steps; a box that begins at 0 has its half added to the origin at once.
        const float range = 0.5f * (mesh.extent_steps[k] * step);
        sizes[k] = absolute(mesh.origin[k] + range) + range;
        const auto side = static_cast<float>(pose.high[k] - pose.low[k]);
        *half[k] = 0.5f * (side * step);
        *center[k] = mesh.origin[k] + (static_cast<float>(pose.low[k]) * step + *half[k]);
    }
    bounds.size = (sizes[0] + sizes[1]) + sizes[2];
    return bounds;
}

PartBounds bounds_of(const BakedScene& tile) {
    const SceneData& data = data_of(tile);
    PartBounds bounds = bounds_of(data.tree);
    bounds.coarsest_step = data.coarsest_step;
    bounds.largest_scale = maximum(data.largest_scale, 1.0f);
    return bounds;
}

void Coarseness::add(const PartBounds& bounds, const Transform& transform) {
    coarsest_step = maximum(detail::without_tiny(transform.scale * bounds.coarsest_step), coarsest_step);
    largest_scale = maximum(detail::without_tiny(transform.scale * bounds.largest_scale), largest_scale);
    farthest_origin = maximum(detail::without_tiny(transform.scale * bounds.size), farthest_origin);
}

Box box_around(const PartBounds& bounds, const Transform& transform) {
    const scalar::BoxEnds<Coordinates> ends = scalar::ends_around<Coordinates>(bounds, transform);
    return {ends.low.vector(), ends.high.vector()};
}

bool find_steps_box(const PartBounds& bounds, const Transform& transform, std::int32_t step_exponent, StepsBox& box) {
    if (!scalar::to_steps(scalar::ends_around<Coordinates>(bounds, transform), step_exponent, box.low, box.high))
        return false;
    for (std::int32_t& steps : box.high) steps = -steps;
    return true;
}

}  // namespace espalier::detail
