#include "asking.h"

void ask_approximations(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const struct asked_shapes shapes = shapes_of(question);
    const float accuracy = question->lengths[3];
    const espalier_ray ray = espalier_default_ray(question->points[1], question->directions[1]);
    espalier_query_counters counters = {0, 0, 0, 0, 0};
    espalier_query_counters* counting = question->bits % 3u == 0 ? NULL : &counters;
    espalier_distance_bounds_result bounds;
    tell_yes_no(asking, espalier_overlaps_sphere_approximate(blob, &shapes.sphere, accuracy, counting));
    tell_counters(asking, &counters);
    tell_yes_no(asking, espalier_overlaps_box_approximate(blob, &shapes.box, accuracy, counting));
    tell_counters(asking, &counters);
    tell(asking, espalier_occluded_approximate(blob, &ray, accuracy, counting).status);
    tell_counters(asking, &counters);
    bounds = espalier_distance_bounds(blob, question->points[2], question->lengths[1], accuracy, counting);
    tell(asking, bounds.status);
    tell_float(asking, bounds.value.lower);
    tell_float(asking, bounds.value.upper);
    tell_counters(asking, &counters);
}
