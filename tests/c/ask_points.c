#include "asking.h"

static void tell_nearest(struct asking* asking, const espalier_nearest* nearest) {
    tell_point(asking, nearest->point);
    tell_float(asking, nearest->distance);
    tell_float(asking, nearest->u);
    tell_float(asking, nearest->v);
    tell(asking, nearest->triangle);
    tell(asking, nearest->feature);
}

static void tell_pair(struct asking* asking, const espalier_nearest_pair* pair) {
    tell_point(asking, pair->on_shape);
    tell_point(asking, pair->on_surface);
    tell_float(asking, pair->distance);
    tell_float(asking, pair->u);
    tell_float(asking, pair->v);
    tell(asking, pair->triangle);
}

static void tell_result(struct asking* asking, espalier_float_result result) {
    tell_float(asking, result.value);
    tell(asking, result.status);
}

static void ask_rounding(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const espalier_vec3* points = question->points;
    const espalier_segment segment = {points[0], points[1]};
    const espalier_sphere sphere = {points[2], question->lengths[0]};
    const espalier_capsule capsule = {points[2], points[3], question->lengths[1]};
    const espalier_box box = {points[0], points[3]};
    const espalier_oriented_box oriented = {
        points[1], {question->directions[0], question->directions[1], question->directions[2]}};
    const espalier_corners triangle = {points[0], points[1], points[2]};
    const espalier_ray ray = espalier_ray_from(points[0], question->directions[0]);
    tell_result(asking, espalier_rounding_error_point(blob, points[0]));
    tell_result(asking, espalier_rounding_error_ray(blob, &ray));
    tell_result(asking, espalier_rounding_error_segment(blob, &segment));
    tell_result(asking, espalier_rounding_error_sphere(blob, &sphere));
    tell_result(asking, espalier_rounding_error_capsule(blob, &capsule));
    tell_result(asking, espalier_rounding_error_box(blob, &box));
    tell_result(asking, espalier_rounding_error_oriented_box(blob, &oriented));
    tell_result(asking, espalier_rounding_error_triangle(blob, &triangle));
}

void ask_points(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const espalier_vec3 point = question->points[0];
    const float max_distance = question->lengths[0];
    espalier_nearest nearest, some[6];
    espalier_nearest_pair pair;
    espalier_segment segment;
    espalier_box box;
    bool inside = false;
    size_t count;
    memset(&nearest, 0, sizeof nearest);
    memset(&pair, 0, sizeof pair);
    tell(asking, espalier_closest_point(blob, point, max_distance, &nearest));
    tell_nearest(asking, &nearest);
    count = espalier_closest_triangles(blob, point, max_distance, some, 6);
    tell(asking, (uint32_t)count);
    for (size_t i = 0; i < count; ++i) tell_nearest(asking, &some[i]);
    segment.from = point;
    segment.to = question->points[1];
    tell(asking, espalier_closest_to_segment(blob, &segment, question->lengths[1], &pair));
    tell_pair(asking, &pair);
    box.min = question->points[2];
    box.max = question->points[3];
    tell(asking, espalier_closest_to_box(blob, &box, question->lengths[2], &pair));
    tell_pair(asking, &pair);
    tell(asking, espalier_contains(blob, point, &inside));
    tell(asking, inside);
    tell(asking, espalier_signed_distance(blob, question->points[1], question->lengths[3], &nearest));
    tell_nearest(asking, &nearest);
    ask_rounding(asking);
}
