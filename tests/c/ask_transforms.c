#include "asking.h"

static void tell_triangle(struct asking* asking, espalier_triangle triangle) {
    tell_point(asking, triangle.a);
    tell_point(asking, triangle.b);
    tell_point(asking, triangle.c);
}

static void tell_segment(struct asking* asking, espalier_segment segment) {
    tell_point(asking, segment.from);
    tell_point(asking, segment.to);
}

static void tell_sphere(struct asking* asking, espalier_sphere sphere) {
    tell_point(asking, sphere.center);
    tell_float(asking, sphere.radius);
}

static void tell_capsule(struct asking* asking, espalier_capsule capsule) {
    tell_point(asking, capsule.from);
    tell_point(asking, capsule.to);
    tell_float(asking, capsule.radius);
}

static void tell_oriented_box(struct asking* asking, espalier_oriented_box box) {
    tell_point(asking, box.center);
    for (int i = 0; i < 3; ++i) tell_point(asking, box.half_axes[i]);
}

static void tell_cone(struct asking* asking, espalier_cone cone) {
    tell_point(asking, cone.apex);
    tell_point(asking, cone.axis);
    tell_float(asking, cone.radius);
}

static void tell_ray(struct asking* asking, espalier_ray ray) {
    tell_point(asking, ray.origin);
    tell_point(asking, ray.direction);
    tell_float(asking, ray.t_min);
    tell_float(asking, ray.t_max);
    tell(asking, ray.culling);
}

static void ask_placing(struct asking* asking, const espalier_transform* transform) {
    const struct question* question = asking->question;
    const espalier_vec3* points = question->points;
    const espalier_vec3 way = question->directions[3];
    const espalier_transform identity = espalier_identity();
    const espalier_ray ray = espalier_default_ray(points[0], question->directions[0]);
    const struct asked_shapes shapes = shapes_of(question);
    espalier_plane plane;
    espalier_box moved;
    plane.normal = question->directions[2];
    plane.offset = question->lengths[2];

    tell_point(asking, espalier_to_local_point(transform, points[0]));
    tell_segment(asking, espalier_to_local_segment(transform, &shapes.segment));
    tell_sphere(asking, espalier_to_local_sphere(transform, &shapes.sphere));
    tell_capsule(asking, espalier_to_local_capsule(transform, &shapes.capsule));
    tell_triangle(asking, espalier_to_local_triangle(transform, &shapes.triangle));
    tell_oriented_box(asking, espalier_to_local_box(transform, &shapes.box));
    tell_oriented_box(asking, espalier_to_local_oriented_box(transform, &shapes.oriented_box));
    tell_cone(asking, espalier_to_local_cone(transform, &shapes.cone));
    plane = espalier_to_local_plane(transform, &plane);
    tell_point(asking, plane.normal);
    tell_float(asking, plane.offset);
    tell_ray(asking, espalier_to_local_ray(transform, &ray));
    tell_transform(asking, espalier_to_local_transform(transform, &identity));
    tell_point(asking, espalier_direction_to_local(transform, way));
    tell_point(asking, espalier_to_world_point(transform, points[1]));
    tell_point(asking, espalier_direction_to_world(transform, way));
    tell_point(asking, espalier_normal_to_world(transform, way));

    tell_point(asking, espalier_translated_point(points[0], way));
    tell_segment(asking, espalier_translated_segment(&shapes.segment, way));
    tell_sphere(asking, espalier_translated_sphere(&shapes.sphere, way));
    tell_capsule(asking, espalier_translated_capsule(&shapes.capsule, way));
    tell_triangle(asking, espalier_translated_triangle(&shapes.triangle, way));
    moved = espalier_translated_box(&shapes.box, way);
    tell_point(asking, moved.min);
    tell_point(asking, moved.max);
    tell_oriented_box(asking, espalier_translated_oriented_box(&shapes.oriented_box, way));
    tell_cone(asking, espalier_translated_cone(&shapes.cone, way));
    tell_ray(asking, espalier_translated_ray(&ray, way));
}

void ask_transforms(struct asking* asking) {
    const struct question* question = asking->question;
    const float scaled[12] = {0, -2, 0, 5, 2, 0, 0, 6, 0, 0, 2, 7};
    float rows[12];
    espalier_transform_result result = espalier_transform_from_matrix(scaled);
    espalier_transform transform = espalier_identity();
    ask_placing(asking, &transform);
    memcpy(&transform.rotation, question->rotation, sizeof transform.rotation);
    transform.translation = question->directions[1];
    transform.scale = question->lengths[0];
    ask_placing(asking, &transform);
    tell_transform(asking, result.value);
    tell(asking, result.status);
    memcpy(rows, question->points, sizeof rows);
    tell(asking, espalier_transform_from_matrix(rows).status);
}
