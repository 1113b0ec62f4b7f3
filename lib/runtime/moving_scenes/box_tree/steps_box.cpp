#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

/// Returns the last whole number at or below x, which is at most 2^30 large.
std::int32_t whole_below(float x) {
    const auto whole = static_cast<std::int32_t>(x);
    return whole - (static_cast<float>(whole) > x ? 1 : 0);
}

/// Returns at least how far a point of the part is from its local origin along any axis.
float size_of(const PartBounds& bounds) {
    const Vec3 &c = bounds.center, &h = bounds.half;
    return ((absolute(c.x) + h.x) + (absolute(c.y) + h.y)) + (absolute(c.z) + h.z);
}

}  // namespace

PartBounds bounds_of(const BlobData& mesh) {
    const float step = power_of_two(mesh.step_exponent);
    PartBounds bounds = {{}, {}, step, 1.0f};
    float* const center[3] = {&bounds.center.x, &bounds.center.y, &bounds.center.z};
    float* const half[3] = {&bounds.half.x, &bounds.half.y, &bounds.half.z};
    for (int k = 0; k < 3; ++k) {
        *half[k] = 0.5f * (mesh.extent_steps[k] * step);
        *center[k] = mesh.origin[k] + *half[k];
    }
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
    coarsest_step = maximum(transform.scale * bounds.coarsest_step, coarsest_step);
    largest_scale = maximum(transform.scale * bounds.largest_scale, largest_scale);
    farthest_origin = maximum(transform.scale * size_of(bounds), farthest_origin);
}

Box box_around(const PartBounds& bounds, const Transform& transform) {
    const PreparedTransform prepared(transform);
    const Vec3& c = bounds.center;
    const Vec3& h = bounds.half;
    const Vec3 middle = prepared.direction_to_world(c);
    const Vec3 axes[3] = {prepared.direction_to_world({h.x, 0.0f, 0.0f}),
                          prepared.direction_to_world({0.0f, h.y, 0.0f}),
                          prepared.direction_to_world({0.0f, 0.0f, h.z})};
    const float margin = transform.scale * size_of(bounds) * 0x1p-16f + 0x1p-97f;
    Box box;
    const auto find = [&](float Vec3::*k) {
        const float half = absolute(axes[0].*k) + absolute(axes[1].*k) + absolute(axes[2].*k);
        const float by = transform.translation.*k, from = middle.*k;
        const float reach = half + (margin + (absolute(by) + absolute(from)) * 0x1p-21f);
        box.min.*k = (from + by) - reach;
        box.max.*k = (from + by) + reach;
    };
    find(&Vec3::x);
    find(&Vec3::y);
    find(&Vec3::z);
    return box;
}

bool find_steps_box(const PartBounds& bounds, const Transform& transform, std::int32_t step_exponent, StepsBox& box) {
    const Box around = box_around(bounds, transform);
    const float to_steps = power_of_two(-step_exponent);
    const float low[3] = {around.min.x * to_steps, around.min.y * to_steps, around.min.z * to_steps};
    const float high[3] = {around.max.x * to_steps, around.max.y * to_steps, around.max.z * to_steps};
    for (int k = 0; k < 3; ++k) {
        constexpr auto most = static_cast<float>(most_world_steps);
        if (!(low[k] >= -most && high[k] <= most)) return false;
        box.low[k] = whole_below(low[k]);
        box.high[k] = -whole_below(-high[k]);
    }
    return true;
}

}  // namespace espalier::detail
