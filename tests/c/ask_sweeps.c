#include "asking.h"

#define ASK(shape, value)                                                                                    \
    do {                                                                                                     \
        tell_sweep_hit(asking, espalier_sweep_##shape(asking->blob, value, way));                            \
        tell_sweep_hit(asking, espalier_sweep_##shape##_filtered(asking->blob, value, way, counts, asking)); \
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
