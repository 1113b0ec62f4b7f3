#include "asking.h"

static void tell_hit(struct asking* asking, const espalier_sweep_hit* hit) {
    tell_float(asking, hit->t);
    tell_point(asking, hit->point);
    tell_point(asking, hit->normal);
    tell(asking, hit->triangle);
    tell(asking, hit->starts_overlapping);
}

#define ASK(shape, value)                                                                                \
    do {                                                                                                 \
        espalier_sweep_hit hit;                                                                          \
        memset(&hit, 0, sizeof hit);                                                                     \
        tell(asking, espalier_check_sweep_##shape(asking->blob, value, way));                            \
        tell(asking, espalier_sweep_##shape(asking->blob, value, way, &hit));                            \
        tell_hit(asking, &hit);                                                                          \
        tell(asking, espalier_sweep_##shape##_filtered(asking->blob, value, way, &hit, counts, asking)); \
        tell_hit(asking, &hit);                                                                          \
    } while (0)

void ask_sweeps(struct asking* asking) {
    const struct question* question = asking->question;
    const espalier_vec3 way = question->directions[0];
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_box box;
    sphere.center = question->points[0];
    sphere.radius = question->lengths[0];
    ASK(sphere, &sphere);
    capsule.from = question->points[0];
    capsule.to = question->points[1];
    capsule.radius = question->lengths[1];
    ASK(capsule, &capsule);
    box.min = question->points[2];
    box.max = question->points[3];
    ASK(box, &box);
}
