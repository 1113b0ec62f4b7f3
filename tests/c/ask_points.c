#include "asking.h"

static void tell_result(struct asking* asking, espalier_float_result result) {
    tell_float(asking, result.value);
    tell(asking, result.status);
}

static void ask_rounding(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const espalier_vec3* points = question->points;
    const struct asked_shapes shapes = shapes_of(question);
    const espalier_ray ray = espalier_default_ray(points[0], question->directions[0]);
    const espalier_vec3 way = question->directions[1];
    tell_result(asking, espalier_rounding_error_point(blob, points[0]));
    tell_result(asking, espalier_rounding_error_ray(blob, &ray));
    tell_result(asking, espalier_rounding_error_segment(blob, &shapes.segment));
    tell_result(asking, espalier_rounding_error_sphere(blob, &shapes.sphere));
    tell_result(asking, espalier_rounding_error_capsule(blob, &shapes.capsule));
    tell_result(asking, espalier_rounding_error_box(blob, &shapes.box));
    tell_result(asking, espalier_rounding_error_oriented_box(blob, &shapes.oriented_box));
    tell_result(asking, espalier_rounding_error_triangle(blob, &shapes.triangle));
    tell_result(asking, espalier_rounding_error_sweep_sphere(blob, &shapes.sphere, way));
    tell_result(asking, espalier_rounding_error_sweep_capsule(blob, &shapes.capsule, way));
    tell_result(asking, espalier_rounding_error_sweep_box(blob, &shapes.box, way));
    tell_result(asking, espalier_rounding_error_sweep_oriented_box(blob, &shapes.oriented_box, way));
    tell_result(asking, espalier_rounding_error_sweep_convex_hull(blob, &shapes.convex_hull, way));
}

static void tell_contacts(struct asking* asking, espalier_filled filled, espalier_contact* contacts) {
    tell(asking, (uint32_t)filled.count);
    tell(asking, filled.status);
    tell(asking, (uint32_t)espalier_reduce_contacts(contacts, filled.count));
    for (size_t i = 0; i < filled.count; ++i) {
        tell_point(asking, contacts[i].point);
        tell_point(asking, contacts[i].normal);
        tell_float(asking, contacts[i].distance);
        tell(asking, contacts[i].triangle);
        tell(asking, contacts[i].feature);
        tell(asking, contacts[i].side);
    }
}

static void ask_contacts(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct asked_shapes shapes = shapes_of(asking->question);
    const float margin = asking->question->lengths[3];
    espalier_contact contacts[9];
    tell_contacts(asking, espalier_find_contacts_sphere(blob, &shapes.sphere, margin, contacts, 9), contacts);
    tell_contacts(asking, espalier_find_contacts_capsule(blob, &shapes.capsule, margin, contacts, 9), contacts);
    tell_contacts(asking, espalier_find_contacts_oriented_box(blob, &shapes.oriented_box, margin, contacts, 9),
                  contacts);
    tell_contacts(asking, espalier_find_contacts_convex_hull(blob, &shapes.convex_hull, margin, contacts, 9), contacts);
}

void ask_points(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const struct asked_shapes shapes = shapes_of(question);
    const espalier_vec3 point = question->points[0];
    const float max_distance = question->lengths[0];
    espalier_closest_point_result some[6];
    espalier_filled filled;
    espalier_yes_no inside;
    tell_closest_point(asking, espalier_closest_point(blob, point, max_distance));
    filled = espalier_closest_triangles(blob, point, some, 6, max_distance);
    tell(asking, (uint32_t)filled.count);
    tell(asking, filled.status);
    for (size_t i = 0; i < filled.count; ++i) tell_closest_point(asking, some[i]);
    tell_closest_point(asking, espalier_closest_point_segment(blob, &shapes.segment, question->lengths[1]));
    tell_closest_point(asking, espalier_closest_point_box(blob, &shapes.box, question->lengths[2]));
    inside = espalier_contains(blob, point);
    tell(asking, inside.status);
    tell(asking, espalier_yes(inside));
    tell(asking, espalier_no(inside));
    tell_result(asking, espalier_winding_number(blob, point, question->bits % 9u));
    tell_closest_point(asking, espalier_signed_distance(blob, question->points[1], question->lengths[3]));
    ask_contacts(asking);
    ask_rounding(asking);
}
