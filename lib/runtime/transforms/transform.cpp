// Shapes moved into the local space of a transform and back into the world.
#include <espalier/transform.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns a shape moved into local space, or the shape itself if the transform changes nothing.
template <class Shape, class Move>
Shape moved(const Transform& transform, const Shape& shape, Move move) {
    return is_identity(transform) ? shape : move(PreparedTransform(transform));
}

Vec3 sum(const Vec3& point, const Vec3& displacement) {
    const auto add = [](float a, float b) { return without_tiny(a) + without_tiny(b); };
    return {add(point.x, displacement.x), add(point.y, displacement.y), add(point.z, displacement.z)};
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
        if (!(low[k] <= high[k]) || !is_finite(low[k]) || !is_finite(high[k])) center[k] = half[k] = not_a_number;
    }
    result.center = {center[0], center[1], center[2]};
    result.half_axes[0] = {half[0], 0.0f, 0.0f};
    result.half_axes[1] = {0.0f, half[1], 0.0f};
    result.half_axes[2] = {0.0f, 0.0f, half[2]};
    return result;
}

}  // namespace

Vec3 to_local(const Transform& transform, const Vec3& point) noexcept {
    return moved(transform, point, [&](const PreparedTransform& t) { return t.point_to_local(point); });
}

Segment to_local(const Transform& transform, const Segment& segment) noexcept {
    return moved(transform, segment, [&](const PreparedTransform& t) {
        return Segment{t.point_to_local(segment.from), t.point_to_local(segment.to)};
    });
}

Sphere to_local(const Transform& transform, const Sphere& sphere) noexcept {
    return moved(transform, sphere, [&](const PreparedTransform& t) {
        return Sphere{t.point_to_local(sphere.center), t.length_to_local(sphere.radius)};
    });
}

Capsule to_local(const Transform& transform, const Capsule& capsule) noexcept {
    return moved(transform, capsule, [&](const PreparedTransform& t) {
        return Capsule{t.point_to_local(capsule.from), t.point_to_local(capsule.to), t.length_to_local(capsule.radius)};
    });
}

Triangle to_local(const Transform& transform, const Triangle& triangle) noexcept {
    return moved(transform, triangle, [&](const PreparedTransform& t) {
        return Triangle{t.point_to_local(triangle.a), t.point_to_local(triangle.b), t.point_to_local(triangle.c)};
    });
}

OrientedBox to_local(const Transform& transform, const OrientedBox& box) noexcept {
    return moved(transform, box, [&](const PreparedTransform& t) {
        OrientedBox result;
        result.center = t.point_to_local(box.center);
        for (int k = 0; k < 3; ++k) result.half_axes[k] = t.direction_to_local(box.half_axes[k]);
        return result;
    });
}

OrientedBox to_local(const Transform& transform, const Box& box) noexcept { return to_local(transform, oriented(box)); }

Cone to_local(const Transform& transform, const Cone& cone) noexcept {
    return moved(transform, cone, [&](const PreparedTransform& t) {
        return Cone{t.point_to_local(cone.apex), t.direction_to_local(cone.axis), t.length_to_local(cone.radius)};
    });
}

Plane to_local(const Transform& transform, const Plane& plane) noexcept {
    return moved(transform, plane, [&](const PreparedTransform& t) {
        const Vec3& origin = t.translation();
        const Vec3& normal = plane.normal;
        const float at_origin = without_tiny(without_tiny(normal.x) * origin.x) +
                                without_tiny(without_tiny(normal.y) * origin.y) +
                                without_tiny(without_tiny(normal.z) * origin.z);
        return Plane{t.rotated_back({without_tiny(normal.x), without_tiny(normal.y), without_tiny(normal.z)}),
                     t.length_to_local(without_tiny(plane.offset) - at_origin)};
    });
}

Ray to_local(const Transform& transform, const Ray& ray) noexcept {
    return moved(transform, ray, [&](const PreparedTransform& t) {
        Ray result = ray;
        result.origin = t.point_to_local(ray.origin);
        result.direction = t.direction_to_local(ray.direction);
        return result;
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
        if (!(result.scale >= least_coordinate && result.scale <= greatest_scale)) result.scale = not_a_number;
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
    return moved(transform, normal, [&](const PreparedTransform& t) {
        return t.rotated({without_tiny(normal.x), without_tiny(normal.y), without_tiny(normal.z)});
    });
}

Vec3 translated(const Vec3& point, const Vec3& displacement) noexcept { return sum(point, displacement); }

Segment translated(const Segment& segment, const Vec3& displacement) noexcept {
    return {sum(segment.from, displacement), sum(segment.to, displacement)};
}

Sphere translated(const Sphere& sphere, const Vec3& displacement) noexcept {
    return {sum(sphere.center, displacement), sphere.radius};
}

Capsule translated(const Capsule& capsule, const Vec3& displacement) noexcept {
    return {sum(capsule.from, displacement), sum(capsule.to, displacement), capsule.radius};
}

Triangle translated(const Triangle& triangle, const Vec3& displacement) noexcept {
    return {sum(triangle.a, displacement), sum(triangle.b, displacement), sum(triangle.c, displacement)};
}

Box translated(const Box& box, const Vec3& displacement) noexcept {
    return {sum(box.min, displacement), sum(box.max, displacement)};
}

OrientedBox translated(const OrientedBox& box, const Vec3& displacement) noexcept {
    OrientedBox result = box;
    result.center = sum(box.center, displacement);
    return result;
}

Cone translated(const Cone& cone, const Vec3& displacement) noexcept {
    return {sum(cone.apex, displacement), cone.axis, cone.radius};
}

Ray translated(const Ray& ray, const Vec3& displacement) noexcept {
    Ray result = ray;
    result.origin = sum(ray.origin, displacement);
    return result;
}

}  // namespace espalier
