// Shapes moved into the local space of a transform and back into the world.
#include <espalier/transform.hpp>
#include <runtime/transforms/local_shape.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns a shape moved into local space, or the shape itself if the transform changes nothing.
template <class Shape, class Move>
Shape moved(const Transform& transform, const Shape& shape, Move move) {
    return is_identity(transform) ? shape : move(PreparedTransform(transform));
}

/// What becomes of the parts of a shape that is moved into local space.
struct IntoLocal {
    const PreparedTransform& transform;

    [[nodiscard]] Vec3 point(const Vec3& p) const { return transform.point_to_local(p); }
    [[nodiscard]] Vec3 vector(const Vec3& v) const { return transform.direction_to_local(v); }
    [[nodiscard]] float length(float length) const { return transform.length_to_local(length); }
};
/// What becomes of them where the shape is translated.
struct Translation {
    Vec3 by;

    [[nodiscard]] Vec3 point(const Vec3& p) const { return sum(without_tiny(p), without_tiny(by)); }
    static Vec3 vector(const Vec3& v) { return v; }
    static float length(float length) { return length; }
};

Vec3 mapped(const Vec3& point, const auto& move) { return move.point(point); }
Segment mapped(const Segment& segment, const auto& move) { return {move.point(segment.from), move.point(segment.to)}; }
Sphere mapped(const Sphere& sphere, const auto& move) {
    return {move.point(sphere.center), move.length(sphere.radius)};
}
Capsule mapped(const Capsule& capsule, const auto& move) {
    return {move.point(capsule.from), move.point(capsule.to), move.length(capsule.radius)};
}
Triangle mapped(const Triangle& triangle, const auto& move) {
    return {move.point(triangle.a), move.point(triangle.b), move.point(triangle.c)};
}
OrientedBox mapped(const OrientedBox& box, const auto& move) {
    const Vec3(&half)[3] = box.half_axes;
    return {move.point(box.center), {move.vector(half[0]), move.vector(half[1]), move.vector(half[2])}};
}
Cone mapped(const Cone& cone, const auto& move) {
    return {move.point(cone.apex), move.vector(cone.axis), move.length(cone.radius)};
}
Ray mapped(const Ray& ray, const auto& move) {
    Ray result = ray;
    result.origin = move.point(ray.origin);
    result.direction = move.vector(ray.direction);
    return result;
}

template <class Shape>
Shape local(const Transform& transform, const Shape& shape) {
    return moved(transform, shape, [&](const PreparedTransform& t) { return mapped(shape, IntoLocal{t}); });
}
template <class Shape>
Shape shifted(const Shape& shape, const Vec3& displacement) {
    return mapped(shape, Translation{displacement});
}

/// An axis-aligned box in the form of an oriented one.
OrientedBox oriented(const Box& box) {
    OrientedBox result;
    const float low[3] = {box.min.x, box.min.y, box.min.z}, high[3] = {box.max.x, box.max.y, box.max.z};
    float center[3], half[3];
    for (int k = 0; k < 3; ++k) {
        const float half_low = 0.5f * without_tiny(low[k]), half_high = 0.5f * without_tiny(high[k]);
        center[k] = half_low + half_high;
        half[k] = half_high - half_low;
        if (!(flush_subnormal(low[k]) <= flush_subnormal(high[k])) || !is_finite(low[k]) || !is_finite(high[k]))
            center[k] = half[k] = not_a_number;
    }
    result.center = {center[0], center[1], center[2]};
    result.half_axes[0] = {half[0], 0.0f, 0.0f};
    result.half_axes[1] = {0.0f, half[1], 0.0f};
    result.half_axes[2] = {0.0f, 0.0f, half[2]};
    return result;
}

}  // namespace

Vec3 to_local(const Transform& transform, const Vec3& point) noexcept { return local(transform, point); }
Segment to_local(const Transform& transform, const Segment& segment) noexcept { return local(transform, segment); }
Sphere to_local(const Transform& transform, const Sphere& sphere) noexcept { return local(transform, sphere); }
Capsule to_local(const Transform& transform, const Capsule& capsule) noexcept { return local(transform, capsule); }
Triangle to_local(const Transform& transform, const Triangle& triangle) noexcept { return local(transform, triangle); }
OrientedBox to_local(const Transform& transform, const OrientedBox& box) noexcept { return local(transform, box); }
Cone to_local(const Transform& transform, const Cone& cone) noexcept { return local(transform, cone); }
Ray to_local(const Transform& transform, const Ray& ray) noexcept { return local_ray(transform, ray); }
OrientedBox to_local(const Transform& transform, const Box& box) noexcept { return to_local(transform, oriented(box)); }

Plane to_local(const Transform& transform, const Plane& plane) noexcept {
    return moved(transform, plane, [&](const PreparedTransform& t) {
        const Vec3& origin = t.translation();
        const Vec3 normal = without_tiny(plane.normal);
        const float at_origin =
            without_tiny(normal.x * origin.x) + without_tiny(normal.y * origin.y) + without_tiny(normal.z * origin.z);
        return Plane{t.rotated_back(normal), t.length_to_local(without_tiny(plane.offset) - at_origin)};
    });
}

Transform to_local(const Transform& outer, const Transform& inner) noexcept {
    return moved(outer, inner, [&](const PreparedTransform& t) {
        const Quaternion a = with_greatest_of_one(outer.rotation), b = with_greatest_of_one(inner.rotation);
        Transform result;
        result.rotation.w = (a.w * b.w + a.x * b.x) + (a.y * b.y + a.z * b.z);
        result.rotation.x = (a.w * b.x - a.x * b.w) - (a.y * b.z - a.z * b.y);
        result.rotation.y = (a.w * b.y - a.y * b.w) - (a.z * b.x - a.x * b.z);
        result.rotation.z = (a.w * b.z - a.z * b.w) - (a.x * b.y - a.y * b.x);
        result.translation = t.point_to_local(inner.translation);
        result.scale = t.length_to_local(inner.scale);
        if (!is_in_range(result.scale)) result.scale = not_a_number;
        return result;
    });
}

Vec3 direction_to_local(const Transform& transform, const Vec3& direction) noexcept {
    return moved(transform, direction, [&](const PreparedTransform& t) { return t.direction_to_local(direction); });
}

Vec3 to_world(const Transform& transform, const Vec3& point) noexcept {
    return moved(transform, point, [&](const PreparedTransform& t) { return t.point_to_world(point); });
}

Vec3 direction_to_world(const Transform& transform, const Vec3& direction) noexcept {
    return moved(transform, direction, [&](const PreparedTransform& t) { return t.direction_to_world(direction); });
}

Vec3 normal_to_world(const Transform& transform, const Vec3& normal) noexcept {
    return moved(transform, normal, [&](const PreparedTransform& t) { return t.rotated(without_tiny(normal)); });
}

Vec3 translated(const Vec3& point, const Vec3& displacement) noexcept { return shifted(point, displacement); }
Segment translated(const Segment& segment, const Vec3& displacement) noexcept { return shifted(segment, displacement); }
Sphere translated(const Sphere& sphere, const Vec3& displacement) noexcept { return shifted(sphere, displacement); }
Capsule translated(const Capsule& capsule, const Vec3& displacement) noexcept { return shifted(capsule, displacement); }
Triangle translated(const Triangle& triangle, const Vec3& displacement) noexcept {
    return shifted(triangle, displacement);
}
OrientedBox translated(const OrientedBox& box, const Vec3& displacement) noexcept { return shifted(box, displacement); }
Cone translated(const Cone& cone, const Vec3& displacement) noexcept { return shifted(cone, displacement); }
Ray translated(const Ray& ray, const Vec3& displacement) noexcept { return shifted(ray, displacement); }
Box translated(const Box& box, const Vec3& displacement) noexcept {
    return {shifted(box.min, displacement), shifted(box.max, displacement)};
}

}  // namespace espalier
