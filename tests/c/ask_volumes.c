#include "asking.h"

static void tell_page(struct asking* asking, const espalier_triangle_id* triangles, espalier_filled page) {
    tell(asking, page.status);
    tell(asking, (uint32_t)page.count);
    for (int i = 0; i < 3; ++i) tell(asking, page.next.place[i]);
    for (size_t i = 0; i < page.count; ++i) tell(asking, triangles[i]);
}

/* Three ways of asking about one shape, and a second page. */
#define ASK(shape, at)                                                                             \
    do {                                                                                           \
        const espalier_cursor begin = {{0, 0, 0}};                                                 \
        espalier_triangle_id triangles[4];                                                         \
        espalier_filled page;                                                                      \
        tell_yes_no(asking, espalier_overlaps_##shape(asking->blob, at));                          \
        asking->visits = asking->question->bits % 9u;                                              \
        tell(asking, espalier_for_each_overlap_##shape(asking->blob, at, visit_triangle, asking)); \
        page = espalier_collect_overlaps_##shape(asking->blob, at, triangles, 4, begin);           \
        tell_page(asking, triangles, page);                                                        \
        page = espalier_collect_overlaps_##shape(asking->blob, at, triangles, 3, page.next);       \
        tell_page(asking, triangles, page);                                                        \
    } while (0)

void ask_volumes(struct asking* asking) {
    const struct question* question = asking->question;
    const struct asked_shapes shapes = shapes_of(question);
    espalier_plane planes[4];
    espalier_convex_volume volume;
    espalier_lattice lattice;
    espalier_lattice_box steps;
    ASK(sphere, &shapes.sphere);
    ASK(capsule, &shapes.capsule);
    ASK(box, &shapes.box);
    ASK(oriented_box, &shapes.oriented_box);
    ASK(cone, &shapes.cone);
    ASK(triangle, &shapes.triangle);
    for (int i = 0; i < 4; ++i) {
        planes[i].normal = question->directions[i];
        planes[i].offset = question->lengths[i];
    }
    volume.planes = planes;
    volume.plane_count = question->bits % 5u;
    ASK(convex_volume, &volume);
    lattice = espalier_blob_lattice(asking->blob);
    steps = espalier_to_lattice_box(&lattice, &shapes.box).value;
    ASK(lattice_box, &steps);
    memcpy(&steps, question->points, sizeof steps); /* any bits */
    ASK(lattice_box, &steps);
}
