/* The version of these headers, and the version and structure sizes of the library, for callers that load it at run
 * time. Counterpart of espalier.hpp. */
#ifndef ESPALIER_C_ABI_H
#define ESPALIER_C_ABI_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/shapes.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ESPALIER_VERSION "0.1.0"
#define ESPALIER_VERSION_MAJOR 0
#define ESPALIER_VERSION_MINOR 1
#define ESPALIER_VERSION_PATCH 0

/* Returns the version of the library, a static string, as ESPALIER_VERSION is that of the headers. Before 1.0, two
 * versions that differ in the second number differ in structures and functions. */
const char* espalier_version(void);
/* Returns the size in bytes of a structure of espalier.h in the library, by its name without espalier_, such as
 * "ray_hit", and 0 for other names. For callers that load the library and lay out structures themselves. */
size_t espalier_size_of(const char* name);

/* The version of the library and the sizes of its structures in bytes, each under its name. Later versions may add
 * sizes, so compare espalier_version() first: a caller that does not know them must not call espalier_abi(). */
#define ESPALIER_SIZE_(name, Cpp) uint16_t name;
typedef struct ESPALIER_SHARED_ espalier_abi_sizes {
    uint16_t version_major, version_minor, version_patch;
    uint16_t yes_no, cursor, filled, vec3, triangle, segment;
    ESPALIER_SHAPES_(ESPALIER_SIZE_) /* sphere, capsule, box, oriented_box, cone */
    uint16_t plane, blob;
    uint16_t lattice, contact, edge_kinds, edge_kinds_result, k_dop, sphere_result, oriented_box_result, k_dop_result,
        ray;
    uint16_t ray_hit, original_triangle, original_triangle_result, original_hit, convex_volume, triangle_result;
    uint16_t closest_point_result, float_result, sweep_hit, quaternion, transform, transform_result;
    uint16_t placed_blob, pair_contact, blob_distance;
    uint16_t query_counters, pair_counters, scene_counters, distance_bounds_result, tree_child, tree_node,
        lattice_point;
    uint16_t lattice_box, lattice_segment;
    uint16_t lattice_point_result, lattice_box_result, lattice_hit, lattice_result, rounded_ray;
    uint16_t instance_id, instance, instance_result, mesh_result, scene, scene_ray_hit, scene_closest_point_result,
        scene_sweep_hit, scene_contact;
    uint16_t instance_handle, instance_handle_result, box_result, movement, moving_scene;
    uint16_t instance_pair, baked_pair, pair_filter, filled_instance_pairs, filled_baked_pairs;
    uint16_t deformable, refit_result;
    uint16_t convex_hull, sweep_options, pair_touch;
    uint16_t strided_vec3, strided_float, strided_triangle_id, filled_lists;
    uint16_t ray_arrays, sphere_arrays, box_arrays;
    uint16_t scene_sweep_options, vec3d, contact_plane, vec3_result, triangle_data, triangle_data_result;
} espalier_abi_sizes;
#undef ESPALIER_SIZE_

/* Returns the version and the sizes that the library was built with. */
espalier_abi_sizes espalier_abi(void);

#ifdef __cplusplus
}
#endif

#endif
