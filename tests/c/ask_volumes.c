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
    espalier_sphere sphere;
    espalier_capsule capsule;
    espalier_box box;
    espalier_oriented_box oriented;
    espalier_cone cone;
    espalier_triangle triangle;
    espalier_plane planes[4];
    espalier_convex_volume volume;
    espalier_lattice lattice;
    espalier_lattice_box steps;
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
    cone.apex = question->points[2];
    cone.axis = question->directions[0];
    cone.radius = question->lengths[2];
    ASK(cone, &cone);
    triangle.a = question->points[0];
    triangle.b = question->points[1];
    triangle.c = question->points[2];
    ASK(triangle, &triangle);
    for (int i = 0; i < 4; ++i) {
        planes[i].normal = question->directions[i];
        planes[i].offset = question->lengths[i];
    }
    volume.planes = planes;
    volume.plane_count = question->bits % 5u;
    ASK(convex_volume, &volume);
    lattice = espalier_blob_lattice(asking->blob);
    steps = espalier_to_lattice_box(&lattice, &box).value;
    ASK(lattice_box, &steps);
    memcpy(&steps, question->points, sizeof steps); /* any bits */
    ASK(lattice_box, &steps);
}
