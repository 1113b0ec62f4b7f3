#include "asking.h"

#define ASK(shape, value)                                                                                    \
    do {                                                                                                     \
        tell_sweep_hit(asking, espalier_sweep_##shape(asking->blob, value, way));                            \
        tell_sweep_hit(asking, espalier_sweep_##shape##_filtered(asking->blob, value, way, counts, asking)); \
        tell_sweep_hit(asking, espalier_sweep_##shape##_with_options(asking->blob, value, way, &options));   \
    } while (0)

void ask_sweeps(struct asking* asking) {
    const struct question* question = asking->question;
    const espalier_vec3 way = question->directions[0];
    const struct asked_shapes shapes = shapes_of(question);
    espalier_sweep_options options = {0};
    options.filter = (question->bits & 4) != 0 ? counts : NULL;
    options.user = asking;
    options.skin = question->lengths[1];
    options.culling = (espalier_face_culling)(question->bits & 3);
    options.ignore_leaving = (question->bits & 8) != 0;
    ASK(sphere, &shapes.sphere);
    ASK(capsule, &shapes.capsule);
    ASK(box, &shapes.box);
    ASK(oriented_box, &shapes.oriented_box);
    ASK(convex_hull, &shapes.convex_hull);
}
