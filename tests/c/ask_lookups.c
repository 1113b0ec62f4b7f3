#include "asking.h"

bool counts(espalier_triangle_id triangle, void* user) {
    const struct asking* asking = user;
    return (triangle + asking->question->bits) % 2 == 0;
}

espalier_visit visit_triangle(espalier_triangle_id triangle, const espalier_triangle* corners, void* user) {
    struct asking* asking = user;
    tell(asking, triangle);
    tell_point(asking, corners->a);
    tell_point(asking, corners->b);
    tell_point(asking, corners->c);
    if (asking->visits == 0) return ESPALIER_VISIT_STOP;
    --asking->visits;
    return ESPALIER_VISIT_NEXT;
}

static void tell_blob(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const espalier_lattice lattice = espalier_blob_lattice(blob);
    const espalier_abi_sizes sizes = espalier_abi();
    const espalier_box bounds = espalier_blob_bounds(blob);
    tell(asking,
         sizes.blob == sizeof(espalier_blob) && sizes.scene == sizeof(espalier_scene) &&
             sizes.rounded_ray == sizeof(espalier_rounded_ray) && sizes.moving_scene == sizeof(espalier_moving_scene) &&
             sizes.filled_baked_pairs == sizeof(espalier_filled_baked_pairs) &&
             sizes.deformable == sizeof(espalier_deformable) && sizes.refit_result == sizeof(espalier_refit_result));
    tell(asking, espalier_blob_status(blob));
    tell(asking, espalier_blob_triangle_count(blob));
    tell(asking, espalier_blob_duplicate_reference_count(blob));
    tell(asking, espalier_blob_vertex_count(blob));
    tell(asking, espalier_blob_size(blob));
    tell(asking, espalier_blob_checksum(blob));
    tell(asking, espalier_blob_depth(blob));
    tell(asking, espalier_blob_profile(blob));
    tell_point(asking, lattice.origin);
    tell(asking, (uint32_t)lattice.step_exponent);
    for (int i = 0; i < 3; ++i) tell(asking, (uint32_t)lattice.extent[i]);
    tell_float(asking, espalier_blob_max_error(blob));
    tell_point(asking, bounds.min);
    tell_point(asking, bounds.max);
    tell(asking, espalier_blob_is_closed(blob));
    tell(asking, espalier_blob_is_deformable(blob));
    tell(asking, (uint32_t)espalier_deformable_bytes(blob));
    tell(asking, espalier_blob_has_original_ids(blob));
    tell(asking, espalier_blob_has_materials(blob));
    tell(asking, espalier_blob_has_edge_flags(blob));
}

static void tell_bounds(struct asking* asking) {
    const espalier_blob* blob = asking->blob;
    const espalier_sphere_result around = espalier_bounding_sphere(blob);
    const espalier_oriented_box_result oriented = espalier_oriented_bounds(blob);
    const espalier_k_dop_result k_dop = espalier_k_dop_bounds(blob);
    tell(asking, around.status);
    tell_point(asking, around.value.center);
    tell_float(asking, around.value.radius);
    tell(asking, oriented.status);
    tell_point(asking, oriented.value.center);
    for (int i = 0; i < 3; ++i) tell_point(asking, oriented.value.half_axes[i]);
    tell(asking, k_dop.status);
    for (int i = 0; i < ESPALIER_K_DOP_COUNT; ++i) {
        tell_point(asking, espalier_k_dop_directions[i]);
        tell_float(asking, k_dop.value.lo[i]);
        tell_float(asking, k_dop.value.hi[i]);
    }
}

static void tell_about(struct asking* asking, espalier_triangle_id triangle) {
    const struct question* question = asking->question;
    const espalier_edge_kinds_result kinds = espalier_edge_kinds_of(asking->blob, triangle);
    const espalier_feature feature = (espalier_feature)(question->bits % 8u); /* one value more than there are */
    const espalier_triangle_result corners = espalier_triangle_at(asking->blob, triangle);
    tell_original_triangle(asking, espalier_original_triangle_of(asking->blob, triangle));
    tell(asking, espalier_material(asking->blob, triangle));
    tell(asking, kinds.status);
    tell(asking, kinds.value.ab);
    tell(asking, kinds.value.bc);
    tell(asking, kinds.value.ca);
    tell_point(asking, espalier_fix_internal_edge_normal(asking->blob, triangle, feature, question->directions[0]));
    tell(asking, corners.status);
    tell_point(asking, corners.value.a);
    tell_point(asking, corners.value.b);
    tell_point(asking, corners.value.c);
}

void ask_lookups(struct asking* asking) {
    const uint32_t count = espalier_blob_triangle_count(asking->blob);
    tell_blob(asking);
    tell_bounds(asking);
    tell_about(asking, asking->question->bits % (count + 1u));
    tell_about(asking, asking->question->bits);
    tell_about(asking, ESPALIER_NO_TRIANGLE);
}

static espalier_node_visit visit_node(const espalier_tree_node* node, void* user) {
    struct asking* asking = user;
    tell(asking, node->number);
    tell(asking, node->depth);
    tell(asking, node->child_count);
    for (unsigned i = 0; i < node->child_count; ++i) {
        const espalier_tree_child* child = &node->children[i];
        tell_point(asking, child->box.min);
        tell_point(asking, child->box.max);
        tell(asking, child->is_leaf);
        tell(asking, child->node);
        tell(asking, child->first);
        tell(asking, child->count);
    }
    if (asking->visits-- == 0) return 99; /* stops, as any value does that is not one of the others */
    return node->number % 3u == 2u ? ESPALIER_NODE_SKIP : ESPALIER_NODE_DESCEND;
}

void ask_walks(struct asking* asking) {
    asking->visits = asking->question->bits % 200u;
    tell(asking, espalier_for_each_triangle(asking->blob, visit_triangle, asking));
    asking->visits = asking->question->bits % 30u;
    tell(asking, espalier_for_each_node(asking->blob, visit_node, asking));
}
