#include "asking.h"

bool counts(espalier_triangle triangle, void* user) {
    const struct asking* asking = user;
    return (triangle + asking->question->bits) % 2 == 0;
}

espalier_visit visit_triangle(espalier_triangle triangle, void* user) {
    struct asking* asking = user;
    tell(asking, triangle);
    if (asking->visits == 0) return ESPALIER_STOP;
    --asking->visits;
    return ESPALIER_KEEP_GOING;
}

static void tell_blob(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    tell(asking, espalier_blob_triangle_count(blob));
    tell(asking, espalier_blob_copy_count(blob));
    tell(asking, espalier_blob_vertex_count(blob));
    tell(asking, espalier_blob_size_bytes(blob));
    tell(asking, espalier_blob_checksum(blob));
    tell(asking, espalier_blob_depth(blob));
    tell(asking, espalier_blob_bits(blob));
    tell(asking, espalier_blob_profile(blob));
    tell_float(asking, espalier_blob_step(blob));
    tell_float(asking, espalier_blob_max_error(blob));
    tell_point(asking, espalier_blob_bounds_min(blob));
    tell_point(asking, espalier_blob_bounds_max(blob));
    tell(asking, espalier_blob_closed(blob));
    tell(asking, espalier_blob_has_original_ids(blob));
    tell(asking, espalier_blob_has_materials(blob));
    tell(asking, espalier_blob_has_edge_flags(blob));
}

static void tell_bounds(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const struct question* question = asking->question;
    espalier_sphere sphere = {{0.0f, 0.0f, 0.0f}, -1.0f};
    espalier_oriented_box oriented;
    espalier_k_dop k_dop;
    espalier_box box;
    memset(&oriented, 0, sizeof oriented);
    memset(&k_dop, 0, sizeof k_dop);
    tell(asking, espalier_bounding_sphere(blob, &sphere));
    tell_point(asking, sphere.center);
    tell_float(asking, sphere.radius);
    tell(asking, espalier_oriented_bounds(blob, &oriented));
    tell_point(asking, oriented.center);
    for (int i = 0; i < 3; ++i) tell_point(asking, oriented.half_axes[i]);
    tell(asking, espalier_k_dop_bounds(blob, &k_dop));
    for (int i = 0; i < ESPALIER_K_DOP_COUNT; ++i) {
        tell_point(asking, espalier_k_dop_directions[i]);
        tell_float(asking, k_dop.lo[i]);
        tell_float(asking, k_dop.hi[i]);
    }
    sphere.center = question->points[0];
    sphere.radius = question->lengths[0];
    tell(asking, espalier_is_outside_bounds_sphere(blob, &sphere));
    box.min = question->points[0];
    box.max = question->points[1];
    tell(asking, espalier_is_outside_bounds_box(blob, &box));
}

static void tell_about(struct asking* asking, espalier_triangle triangle) {
    const struct question* question = asking->question;
    espalier_original_triangle original = {7, 7, 7, 7};
    espalier_edge_kinds kinds = {9, 9, 9};
    espalier_contact contact;
    espalier_vec3 normal = {5.0f, 5.0f, 5.0f};
    espalier_corners corners;
    tell(asking, espalier_get_original_triangle(asking->blob, triangle, &original));
    tell(asking, original.file);
    tell(asking, original.mesh);
    tell(asking, original.triangle);
    tell(asking, original.first_corner);
    tell(asking, espalier_material(asking->blob, triangle));
    tell(asking, espalier_get_edge_kinds(asking->blob, triangle, &kinds));
    tell(asking, kinds.ab);
    tell(asking, kinds.bc);
    tell(asking, kinds.ca);
    contact.triangle = triangle;
    contact.feature = (espalier_feature)(question->bits % 8u); /* one value more than there are */
    contact.normal = question->directions[0];
    tell(asking, espalier_is_on_inner_edge(asking->blob, &contact, &normal));
    tell_point(asking, normal);
    memset(&corners, 0, sizeof corners);
    tell(asking, espalier_triangle_corners(asking->blob, triangle, &corners));
    tell_point(asking, corners.a);
    tell_point(asking, corners.b);
    tell_point(asking, corners.c);
}

void ask_lookups(struct asking* asking) {
    const uint32_t count = espalier_blob_triangle_count(asking->blob);
    tell_blob(asking);
    tell_bounds(asking);
    tell_about(asking, asking->question->bits % (count + 1u));
    tell_about(asking, asking->question->bits);
    tell_about(asking, ESPALIER_NO_TRIANGLE);
}
