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

static void tell_transform(struct asking* asking, espalier_transform transform) {
    tell_float(asking, transform.rotation.x);
    tell_float(asking, transform.rotation.y);
    tell_float(asking, transform.rotation.z);
    tell_float(asking, transform.rotation.w);
    tell_point(asking, transform.translation);
    tell_float(asking, transform.scale);
}

static void ask_placing(struct asking* asking, const espalier_transform* transform) {
    const struct question* question = asking->question;
    const espalier_vec3* points = question->points;
    const espalier_vec3 way = question->directions[3];
    const espalier_transform identity = espalier_identity();
    const espalier_ray ray = espalier_default_ray(points[0], question->directions[0]);
    espalier_segment segment;
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_triangle triangle;
    espalier_box box, moved;
    espalier_oriented_box oriented;
    espalier_cone cone;
    espalier_plane plane;
    segment.from = capsule.from = triangle.a = sphere.center = oriented.center = points[0];
    segment.to = capsule.to = triangle.b = points[1];
    triangle.c = points[2];
    capsule.radius = sphere.radius = plane.offset = question->lengths[2];
    box.min = points[2];
    box.max = points[3];
    for (int i = 0; i < 3; ++i) oriented.half_axes[i] = question->directions[i];
    plane.normal = question->directions[2];
    cone.apex = points[0];
    cone.axis = question->directions[0];
    cone.radius = question->lengths[2];

    tell_point(asking, espalier_to_local_point(transform, points[0]));
    tell_segment(asking, espalier_to_local_segment(transform, &segment));
    tell_sphere(asking, espalier_to_local_sphere(transform, &sphere));
    tell_capsule(asking, espalier_to_local_capsule(transform, &capsule));
    tell_triangle(asking, espalier_to_local_triangle(transform, &triangle));
    tell_oriented_box(asking, espalier_to_local_box(transform, &box));
    tell_oriented_box(asking, espalier_to_local_oriented_box(transform, &oriented));
    tell_cone(asking, espalier_to_local_cone(transform, &cone));
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
    tell_segment(asking, espalier_translated_segment(&segment, way));
    tell_sphere(asking, espalier_translated_sphere(&sphere, way));
    tell_capsule(asking, espalier_translated_capsule(&capsule, way));
    tell_triangle(asking, espalier_translated_triangle(&triangle, way));
    moved = espalier_translated_box(&box, way);
    tell_point(asking, moved.min);
    tell_point(asking, moved.max);
    tell_oriented_box(asking, espalier_translated_oriented_box(&oriented, way));
    tell_cone(asking, espalier_translated_cone(&cone, way));
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
