#include <runtime/scenes/shape_bounds.hpp>

#include <runtime/base/bits.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

namespace {

/// The box around points and spheres, which grows from an anchor.
class BoundsBuilder {
public:
    explicit BoundsBuilder(const Vec3& anchor) : bounds_{anchor, {}, {}} { require(anchor); }

    /// Adds a point, given by its way from the anchor, and all points within a distance of it along each axis.
    void add(const Vec3& way, const Vec3& half) {
        require(way);
        bounds_.low = {minimum(way.x - half.x, bounds_.low.x), minimum(way.y - half.y, bounds_.low.y),
                       minimum(way.z - half.z, bounds_.low.z)};
        bounds_.high = {maximum(way.x + half.x, bounds_.high.x), maximum(way.y + half.y, bounds_.high.y),
                        maximum(way.z + half.z, bounds_.high.z)};
    }
    void add_point(const Vec3& point) { add(way_to(point), {}); }
    /// The radius may be infinite.
    void add_sphere(const Vec3& center, float radius) {
        if (!is_radius(radius)) refuse();
        require(center);
        add(way_to(center), {radius, radius, radius});
    }
    /// Marks the shape as one that holds no point, unless it is refused.
    void set_empty() {
        if (bounds_.status == QueryStatus::ok) bounds_.status = QueryStatus::not_found;
    }
    void refuse() { bounds_.status = QueryStatus::invalid_argument; }
    /// Refuses a vector with a NaN or an infinity.
    void require(const Vec3& v) {
        if (!is_finite(v.x) || !is_finite(v.y) || !is_finite(v.z)) refuse();
    }
    /// A difference beyond float32 is its largest number.
    [[nodiscard]] Vec3 way_to(const Vec3& point) const {
        const Vec3& a = bounds_.anchor;
        return {within_range(point.x - a.x), within_range(point.y - a.y), within_range(point.z - a.z)};
    }
    [[nodiscard]] const ShapeBounds& bounds() const { return bounds_; }

private:
    static float within_range(float x) {
        constexpr float most = 0x1.fffffep127f;
        return x > most ? most : x < -most ? -most : x;
    }

    ShapeBounds bounds_;
};

Vec3 magnitudes(const Vec3& v) { return {absolute(v.x), absolute(v.y), absolute(v.z)}; }

}  // namespace

ShapeBounds bounds_of(const Sphere& sphere) noexcept {
    BoundsBuilder builder(sphere.center);
    builder.add_sphere(sphere.center, sphere.radius);
    return builder.bounds();
}

ShapeBounds bounds_of(const Capsule& capsule) noexcept {
    BoundsBuilder builder(capsule.from);
    builder.add_sphere(capsule.from, capsule.radius);
    builder.add_sphere(capsule.to, capsule.radius);
    return builder.bounds();
}

ShapeBounds bounds_of(const Box& box) noexcept {
    BoundsBuilder builder(box.min);
    builder.require(box.max);
    if (is_empty(box)) builder.set_empty();
    // to_local() rounds the middle of the box, which may be farther from the world's origin than from the scene.
    const Vec3 size = sum(magnitudes(box.min), magnitudes(box.max));
    const Vec3 rounding = {size.x * 0x1p-23f, size.y * 0x1p-23f, size.z * 0x1p-23f};
    builder.add({}, rounding);
    builder.add(builder.way_to(box.max), rounding);
    return builder.bounds();
}

ShapeBounds bounds_of(const OrientedBox& box) noexcept {
    BoundsBuilder builder(box.center);
    Vec3 half;
    for (const Vec3& axis : box.half_axes) {
        builder.require(axis);
        half = sum(half, magnitudes(axis));
    }
    builder.add({}, half);
    return builder.bounds();
}

ShapeBounds bounds_of(const Triangle& triangle) noexcept {
    BoundsBuilder builder(triangle.a);
    builder.require(triangle.b);
    builder.require(triangle.c);
    builder.add_point(triangle.b);
    builder.add_point(triangle.c);
    return builder.bounds();
}

ShapeBounds bounds_of(const ConvexHull& hull) noexcept {
    BoundsBuilder builder(hull.vertices.empty() ? Vec3{} : hull.vertices[0]);
    if (hull.vertices.size() > max_hull_vertices) builder.refuse();
    else
        for (const Vec3& vertex : hull.vertices) {
            builder.require(vertex);
            builder.add_point(vertex);
        }
    if (hull.vertices.empty()) builder.set_empty();
    return builder.bounds();
}

ShapeBounds bounds_of(const Cone& cone) noexcept {
    BoundsBuilder builder(cone.apex);
    builder.require({cone.radius, 0.0f, 0.0f});
    if ((magnitude_bits(cone.axis.x) | magnitude_bits(cone.axis.y) | magnitude_bits(cone.axis.z)) == 0)
        builder.refuse();
    builder.add(cone.axis, {cone.radius, cone.radius, cone.radius});
    if (!is_radius(cone.radius)) builder.refuse();
    return builder.bounds();
}

SceneAround scene_around(const SceneData& scene, const ShapeBounds& bounds, float magnitude) {
    const BlobData& tree = scene.tree;
    const float step = power_of_two(tree.step_exponent);
    const Vec3& a = bounds.anchor;
    const float anchor[3] = {a.x, a.y, a.z};
    const float parts[6] = {bounds.low.x, bounds.low.y, bounds.low.z, bounds.high.x, bounds.high.y, bounds.high.z};
    float reach = magnitude;
    for (const float part : parts) reach = maximum(absolute(part), reach);
    SceneAround around;
    for (int k = 0; k < 3; ++k) {
        around.offset[k] = tree.origin[k] - anchor[k];
        reach = maximum(absolute(around.offset[k]), reach);
        reach = maximum(absolute(around.offset[k] + tree.extent_steps[k] * step), reach);
    }
    reach += scene.farthest_origin;
    // to_local() takes numbers below 2^-100 for zero, in the world and in local space.
    const float zeros = scene.largest_scale * 0x1p-96f + 0x1p-94f;
    around.reach = reach;
    around.slack = reach * 0x1p-16f + (scene.coarsest_step * 0x1p-4f + zeros);
    // In a tile, to_local() has moved the shape once more.
    if (scene.tile_count != 0) around.slack = reach * 0x1p-13f + (scene.coarsest_step * 0x1p-3f + zeros * 0x1p4f);
    around.slack += scene.view_slack;
    return around;
}

}  // namespace espalier::detail
