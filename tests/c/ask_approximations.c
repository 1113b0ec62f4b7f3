#include "asking.h"

static void tell_counters(struct asking* asking, const espalier_query_counters* counters) {
    tell(asking, (uint32_t)counters->nodes);
    tell(asking, (uint32_t)counters->leaves);
    tell(asking, (uint32_t)counters->groups);
    tell(asking, (uint32_t)counters->triangles);
    tell(asking, (uint32_t)counters->candidates);
}

void ask_approximations(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    const float accuracy = question->lengths[3];
    const espalier_ray ray = espalier_ray_from(question->points[1], question->directions[1]);
    espalier_query_counters counters = {0, 0, 0, 0, 0};
    espalier_query_counters* counting = question->bits % 3u == 0 ? NULL : &counters;
    espalier_distance_bounds bounds = {-1.0f, -2.0f};
    espalier_sphere sphere;
    espalier_box box;
    sphere.center = question->points[0];
    sphere.radius = question->lengths[0];
    tell(asking, espalier_may_overlap_sphere(blob, &sphere, accuracy, counting));
    tell_counters(asking, &counters);
    box.min = question->points[0];
    box.max = question->points[1];
    tell(asking, espalier_may_overlap_box(blob, &box, accuracy, counting));
    tell_counters(asking, &counters);
    tell(asking, espalier_may_be_occluded(blob, &ray, accuracy, counting));
    tell_counters(asking, &counters);
    tell(asking,
         espalier_get_distance_bounds(blob, question->points[2], question->lengths[1], accuracy, &bounds, counting));
    tell_float(asking, bounds.lower);
    tell_float(asking, bounds.upper);
    tell_counters(asking, &counters);
}
