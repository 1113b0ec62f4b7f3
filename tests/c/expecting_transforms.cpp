#include "expecting.hpp"

#include <cstring>

namespace espalier::tests {

void Expecting::tell(const Segment& segment) {
    tell(segment.from);
    tell(segment.to);
}

void Expecting::tell(const Capsule& capsule) {
    tell(capsule.from);
    tell(capsule.to);
    tell(capsule.radius);
}

void Expecting::tell(const OrientedBox& box) {
    tell(box.center);
    for (const Vec3& axis : box.half_axes) tell(axis);
}

void Expecting::tell(const Ray& ray) {
    tell(ray.origin);
    tell(ray.direction);
    tell(ray.t_min);
    tell(ray.t_max);
    tell(ray.culling);
}

void Expecting::tell(const Transform& transform) {
    for (const float c : {transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w})
        tell(c);
    tell(transform.translation);
    tell(transform.scale);
}

void Expecting::placing(const Transform& transform) {
    const Ray ray = {point(0), direction(0)};
    const Vec3 way = direction(3);
    const auto tell_triangle = [&](const Triangle& t) {
        for (const Vec3& corner : {t.a, t.b, t.c}) tell(corner);
    };
    const auto tell_sphere = [&](const Sphere& moved) {
        tell(moved.center);
        tell(moved.radius);
    };
    const auto tell_cone = [&](const Cone& moved) {
        tell(moved.apex);
        tell(moved.axis);
        tell(moved.radius);
    };

    tell(to_local(transform, point(0)));
    tell(to_local(transform, segment()));
    tell_sphere(to_local(transform, sphere()));
    tell(to_local(transform, capsule()));
    tell_triangle(to_local(transform, triangle()));
    tell(to_local(transform, box()));
    tell(to_local(transform, oriented_box()));
    tell_cone(to_local(transform, cone()));
    const Plane plane = to_local(transform, Plane{direction(2), length(2)});
    tell(plane.normal);
    tell(plane.offset);
    tell(to_local(transform, ray));
    tell(to_local(transform, Transform{}));
    tell(direction_to_local(transform, way));
    tell(to_world(transform, point(1)));
    tell(direction_to_world(transform, way));
    tell(normal_to_world(transform, way));

    tell(translated(point(0), way));
    tell(translated(segment(), way));
    tell_sphere(translated(sphere(), way));
    tell(translated(capsule(), way));
    tell_triangle(translated(triangle(), way));
    tell(translated(box(), way).min);
    tell(translated(box(), way).max);
    tell(translated(oriented_box(), way));
    tell_cone(translated(cone(), way));
    tell(translated(ray, way));
}

void Expecting::transforms() {
    const float scaled[3][4] = {{0, -2, 0, 5}, {2, 0, 0, 6}, {0, 0, 2, 7}};
    const Result<Transform> result = transform_from_matrix(scaled);
    placing({});
    const float* q = asked_.rotation;
    placing({{q[0], q[1], q[2], q[3]}, direction(1), length(0)});
    tell(result.value);
    tell(result.status);
    float rows[3][4];
    static_assert(sizeof rows == sizeof asked_.points);
    std::memcpy(rows, asked_.points, sizeof rows);
    tell(transform_from_matrix(rows).status);
}

}  // namespace espalier::tests
