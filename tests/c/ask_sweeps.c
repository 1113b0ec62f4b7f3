#include "asking.h"

static void tell_hit(struct asking* asking, espalier_sweep_hit hit) {
    tell_float(asking, hit.t);
    tell_point(asking, hit.point);
    tell_point(asking, hit.normal);
    tell_point(asking, hit.face_normal);
    tell(asking, hit.triangle);
    tell(asking, hit.status);
    tell(asking, hit.starts_overlapping);
}

#define ASK(shape, value)                                                                              \
    do {                                                                                               \
        tell_hit(asking, espalier_sweep_##shape(asking->blob, value, way));                            \
        tell_hit(asking, espalier_sweep_##shape##_filtered(asking->blob, value, way, counts, asking)); \
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
