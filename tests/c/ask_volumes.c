#include "asking.h"

static void tell_page(struct asking* asking, const espalier_triangle* triangles, espalier_overlap_page page) {
    tell(asking, page.status);
    tell(asking, page.count);
    tell(asking, page.next);
    for (uint32_t i = 0; i < page.count; ++i) tell(asking, triangles[i]);
}

/* Three ways of asking about one shape, and a second page. */
#define ASK(shape, ...)                                                                                     \
    do {                                                                                                    \
        espalier_triangle triangles[4];                                                                     \
        espalier_overlap_page page;                                                                         \
        tell(asking, espalier_overlaps_##shape(asking->blob, __VA_ARGS__));                                 \
        asking->visits = asking->question->bits % 9u;                                                       \
        tell(asking, espalier_for_each_overlap_##shape(asking->blob, __VA_ARGS__, visit_triangle, asking)); \
        page = espalier_collect_overlaps_##shape(asking->blob, __VA_ARGS__, triangles, 4, 0);               \
        tell_page(asking, triangles, page);                                                                 \
        page = espalier_collect_overlaps_##shape(asking->blob, __VA_ARGS__, triangles, 3, page.next);       \
        tell_page(asking, triangles, page);                                                                 \
    } while (0)

void ask_volumes(struct asking* asking) {
    const struct question* question = asking->question;
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_box box;
    espalier_oriented_box oriented;
    espalier_corners triangle;
    espalier_plane planes[4];
    espalier_lattice lattice;
    espalier_box_in_steps steps = {{0, 0, 0}, {0, 0, 0}};
    sphere.center = question->points[0];
    sphere.radius = question->lengths[0];
    ASK(sphere, &sphere);
    capsule.from = question->points[1];
    capsule.to = question->points[2];
    capsule.radius = question->lengths[1];
    ASK(capsule, &capsule);
    box.min = question->points[0];
    box.max = question->points[3];
    ASK(box, &box);
    oriented.center = question->points[1];
    for (int i = 0; i < 3; ++i) oriented.half_axes[i] = question->directions[i];
    ASK(oriented_box, &oriented);
    triangle.a = question->points[0];
    triangle.b = question->points[1];
    triangle.c = question->points[2];
    ASK(triangle, &triangle);
    for (int i = 0; i < 4; ++i) {
        planes[i].normal = question->directions[i];
        planes[i].offset = question->lengths[i];
    }
    ASK(planes, planes, question->bits % 5u);
    lattice = espalier_lattice_of(asking->blob);
    (void)espalier_steps_around(&lattice, &box, &steps);
    ASK(box_in_steps, &steps);
    memcpy(&steps, question->points, sizeof steps); /* any bits */
    ASK(box_in_steps, &steps);
}
