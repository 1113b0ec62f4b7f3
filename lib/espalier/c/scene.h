/* Scenes: one file with a few meshes and many instances of them, and queries over all instances. Counterpart of
 * scene.hpp.
 *
 * A tile is a scene that another scene instances in place of a mesh.
 *
 * Shapes and results are in world space. Every query considers the instances whose mask shares a bit with `mask`
 * (UINT32_MAX for all), and those of their triangles that the filter keeps. Visitors are called in ascending order of
 * instances or, for the view of a moving scene (scenes/moving_scene.h), in the order of its tree. */
#ifndef ESPALIER_C_SCENE_H
#define ESPALIER_C_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/distance.h>
#include <espalier/c/ray.h>
#include <espalier/c/advanced/rounding.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/sweep.h>
#include <espalier/c/transform.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The index of an instance in its scene and, if that is a tile, of an instance in the tile. For a mesh, and for a tile
 * as a whole, `in_tile` must be ESPALIER_NO_INSTANCE: write {i, ESPALIER_NO_INSTANCE}. */
typedef struct ESPALIER_SHARED_ espalier_instance_id {
    uint32_t index, in_tile;
} espalier_instance_id;
#define ESPALIER_NO_INSTANCE UINT32_C(0xFFFFFFFF)

/* A mesh or a tile, placed in the world. Tiles are numbered after the meshes. */
typedef struct ESPALIER_SHARED_ espalier_instance {
    espalier_transform transform;
    uint32_t mesh, mask, user, source;
} espalier_instance;

typedef struct ESPALIER_SHARED_ espalier_instance_result {
    espalier_instance value;
    espalier_query_status status;
} espalier_instance_result;

/* A mesh, which is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_mesh_result {
    espalier_blob value;
    espalier_query_status status;
} espalier_mesh_result;

/* A view of a baked scene, which can be copied freely and owns nothing. The bytes and the arrays must outlive it and
 * must not change. Filled with zeros, it was never opened: it has no instances, and queries refuse it. Its content may
 * change from version to version. */
typedef struct ESPALIER_BLOB_ espalier_scene {
    unsigned char opaque_[sizeof(void*) == 8 ? 304 : 256];
} espalier_scene;

/* Returns the number of meshes that the header of a scene states, including those of its tiles. espalier_open_scene()
 * needs an array of this size. Returns 0 for bytes that are not a scene, or that are too few for so many meshes. */
uint32_t espalier_scene_mesh_count(const void* bytes, size_t size);
/* Returns the number of tiles that the header of a scene states. */
uint32_t espalier_scene_tile_count(const void* bytes, size_t size);
/* Proves that every query on the bytes is safe, writes a view of them to `scene`, and returns its status, which the
 * scene stores as well. `meshes` receives an open blob for each mesh and `tiles` an open scene for each tile; any other
 * elements are empty. After a refusal, each element is open or empty. None of them need be initialised, and a scene
 * without tiles needs no array for them. If an address is not a multiple of 16, the call is refused with
 * ESPALIER_OPEN_MISALIGNED and writes nothing; do not pass such an address to any other function. */
espalier_open_status espalier_open_scene(const void* bytes, size_t size, espalier_blob* meshes, size_t mesh_capacity,
                                         espalier_scene* tiles, size_t tile_capacity, espalier_scene* scene);

/* Returns ESPALIER_OPEN_OK, or why the scene is not open. */
espalier_open_status espalier_scene_status(const espalier_scene* scene);
uint32_t espalier_scene_instance_count(const espalier_scene* scene);
/* Returns the array of meshes, each an open blob, and writes their number to `count`. */
const espalier_blob* espalier_scene_meshes(const espalier_scene* scene, size_t* count);
/* Returns the array of tiles, each an open scene, and writes their number to `count`. */
const espalier_scene* espalier_scene_tiles(const espalier_scene* scene, size_t* count);
/* Returns the size in bytes, including meshes and tiles. */
uint32_t espalier_scene_size(const espalier_scene* scene);
/* Returns the largest distance between the surface of any instance and its source, in world units. */
float espalier_scene_max_error(const espalier_scene* scene);
/* Returns the point of the source that is the origin of the scene: what the baker subtracted from all positions. It is
 * 0 0 0 for most scenes and for a view of a moving scene. */
espalier_vec3d espalier_scene_source_origin(const espalier_scene* scene);
/* Returns a box around the boxes and the local origins of all instances. */
espalier_box espalier_scene_bounds(const espalier_scene* scene);
/* Returns the region of the instances that lie on one lattice. */
espalier_lattice_result espalier_scene_common_lattice(const espalier_scene* scene);
/* Returns an instance. */
espalier_instance_result espalier_scene_instance_at(const espalier_scene* scene, espalier_instance_id instance);
/* Returns the mesh of an instance. */
espalier_mesh_result espalier_scene_mesh_at(const espalier_scene* scene, espalier_instance_id instance);
/* Returns whether this instance shares the ray that is rounded once for the common lattice. */
espalier_yes_no espalier_scene_is_on_common_lattice(const espalier_scene* scene, espalier_instance_id instance);

/* Returns whether to keep a triangle of an instance. A null filter keeps all. */
typedef bool (*espalier_scene_filter)(espalier_instance_id instance, espalier_triangle_id triangle, void* user);

/* The results of queries on a blob, in world space, with the instance. */
typedef struct ESPALIER_SHARED_ espalier_scene_ray_hit {
    espalier_ray_hit hit;
    espalier_instance_id instance;
} espalier_scene_ray_hit;
typedef struct ESPALIER_SHARED_ espalier_scene_closest_point_result {
    espalier_closest_point_result hit;
    espalier_instance_id instance;
} espalier_scene_closest_point_result;
typedef struct ESPALIER_SHARED_ espalier_scene_sweep_hit {
    espalier_sweep_hit hit;
    espalier_instance_id instance;
} espalier_scene_sweep_hit;

/* Returns the hit with the smallest t. If several hits have the same t, the lowest instance wins, then the lowest
 * triangle. */
espalier_scene_ray_hit espalier_scene_raycast(const espalier_scene* scene, const espalier_ray* ray, uint32_t mask,
                                              espalier_scene_filter filter, void* user);
/* Returns the same for a ray that was rounded for a region of your choice. Instances that lie in the region and on its
 * lattice are tested with `rounded`, all others with `ray`. */
espalier_scene_ray_hit espalier_scene_raycast_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                      const espalier_rounded_ray* rounded, uint32_t mask,
                                                      espalier_scene_filter filter, void* user);
/* Write what the query of each ray returns. Both arrays have `count` elements. */
espalier_filled espalier_scene_raycast_batch(const espalier_scene* scene, const espalier_ray* rays,
                                             espalier_scene_ray_hit* hits, size_t count, uint32_t mask,
                                             espalier_scene_filter filter, void* user);
/* Returns whether the ray hits any triangle. */
espalier_yes_no espalier_scene_occluded(const espalier_scene* scene, const espalier_ray* ray, uint32_t mask,
                                        espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_occluded_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                const espalier_rounded_ray* rounded, uint32_t mask,
                                                espalier_scene_filter filter, void* user);

typedef espalier_visit (*espalier_scene_hit_visitor)(espalier_instance_id instance, const espalier_ray_hit* hit,
                                                     void* user);
/* Call the visitor with each hit, in ascending order of instances and, within one, of triangles. `user` is passed to
 * the visitor, `filter_user` to the filter. */
espalier_query_status espalier_scene_for_each_hit(const espalier_scene* scene, const espalier_ray* ray,
                                                  espalier_scene_hit_visitor visit, void* user, uint32_t mask,
                                                  espalier_scene_filter filter, void* filter_user);
espalier_query_status espalier_scene_for_each_hit_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                          const espalier_rounded_ray* rounded,
                                                          espalier_scene_hit_visitor visit, void* user, uint32_t mask,
                                                          espalier_scene_filter filter, void* filter_user);

/* Returns the closest point of any surface within max_distance, which may be INFINITY. */
espalier_scene_closest_point_result espalier_scene_closest_point(const espalier_scene* scene, espalier_vec3 point,
                                                                 float max_distance, uint32_t mask);

/* Return the first contact of the shape as it moves by `displacement`. */
espalier_scene_sweep_hit espalier_scene_sweep_sphere(const espalier_scene* scene, const espalier_sphere* sphere,
                                                     espalier_vec3 displacement, uint32_t mask,
                                                     espalier_scene_filter filter, void* user);
espalier_scene_sweep_hit espalier_scene_sweep_capsule(const espalier_scene* scene, const espalier_capsule* capsule,
                                                      espalier_vec3 displacement, uint32_t mask,
                                                      espalier_scene_filter filter, void* user);
espalier_scene_sweep_hit espalier_scene_sweep_box(const espalier_scene* scene, const espalier_box* box,
                                                  espalier_vec3 displacement, uint32_t mask,
                                                  espalier_scene_filter filter, void* user);
espalier_scene_sweep_hit espalier_scene_sweep_oriented_box(const espalier_scene* scene,
                                                           const espalier_oriented_box* box, espalier_vec3 displacement,
                                                           uint32_t mask, espalier_scene_filter filter, void* user);
espalier_scene_sweep_hit espalier_scene_sweep_convex_hull(const espalier_scene* scene, const espalier_convex_hull* hull,
                                                          espalier_vec3 displacement, uint32_t mask,
                                                          espalier_scene_filter filter, void* user);

/* Selects the triangles that a sweep considers, and where the shape stops. If all members are zero, it considers all
 * triangles, without a skin. */
typedef struct ESPALIER_SHARED_ espalier_scene_sweep_options {
    espalier_scene_filter filter; /* null keeps all triangles */
    void* user;                   /* passed to `filter` */
    float skin;                   /* in world units */
    espalier_face_culling culling;
    bool ignore_leaving;
    uint8_t reserved[2];
} espalier_scene_sweep_options;

/* Return the first contact with the given options. */
espalier_scene_sweep_hit espalier_scene_sweep_sphere_with_options(const espalier_scene* scene,
                                                                  const espalier_sphere* sphere,
                                                                  espalier_vec3 displacement, uint32_t mask,
                                                                  const espalier_scene_sweep_options* options);
espalier_scene_sweep_hit espalier_scene_sweep_capsule_with_options(const espalier_scene* scene,
                                                                   const espalier_capsule* capsule,
                                                                   espalier_vec3 displacement, uint32_t mask,
                                                                   const espalier_scene_sweep_options* options);
espalier_scene_sweep_hit espalier_scene_sweep_box_with_options(const espalier_scene* scene, const espalier_box* box,
                                                               espalier_vec3 displacement, uint32_t mask,
                                                               const espalier_scene_sweep_options* options);
espalier_scene_sweep_hit espalier_scene_sweep_oriented_box_with_options(const espalier_scene* scene,
                                                                        const espalier_oriented_box* box,
                                                                        espalier_vec3 displacement, uint32_t mask,
                                                                        const espalier_scene_sweep_options* options);
espalier_scene_sweep_hit espalier_scene_sweep_convex_hull_with_options(const espalier_scene* scene,
                                                                       const espalier_convex_hull* hull,
                                                                       espalier_vec3 displacement, uint32_t mask,
                                                                       const espalier_scene_sweep_options* options);

typedef espalier_visit (*espalier_instance_visitor)(espalier_instance_id instance, void* user);
/* Calls the visitor with each instance whose box in the tree touches the box, in ascending order; for a tile, with each
 * instance in it whose box does. */
espalier_query_status espalier_scene_for_each_candidate(const espalier_scene* scene, const espalier_box* box,
                                                        espalier_instance_visitor visit, void* user, uint32_t mask);

/* Return whether any triangle touches the shape. */
espalier_yes_no espalier_scene_overlaps_sphere(const espalier_scene* scene, const espalier_sphere* sphere,
                                               uint32_t mask, espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_overlaps_capsule(const espalier_scene* scene, const espalier_capsule* capsule,
                                                uint32_t mask, espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_overlaps_box(const espalier_scene* scene, const espalier_box* box, uint32_t mask,
                                            espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_overlaps_oriented_box(const espalier_scene* scene, const espalier_oriented_box* box,
                                                     uint32_t mask, espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_overlaps_cone(const espalier_scene* scene, const espalier_cone* cone, uint32_t mask,
                                             espalier_scene_filter filter, void* user);
espalier_yes_no espalier_scene_overlaps_triangle(const espalier_scene* scene, const espalier_triangle* triangle,
                                                 uint32_t mask, espalier_scene_filter filter, void* user);

typedef espalier_visit (*espalier_scene_triangle_visitor)(espalier_instance_id instance, espalier_triangle_id triangle,
                                                          void* user);
/* Visit every triangle that touches the shape, in ascending order of instances, until the visitor stops. `user` is
 * passed to the visitor, `filter_user` to the filter. */
espalier_query_status espalier_scene_for_each_overlap_sphere(const espalier_scene* scene, const espalier_sphere* sphere,
                                                             espalier_scene_triangle_visitor visit, void* user,
                                                             uint32_t mask, espalier_scene_filter filter,
                                                             void* filter_user);
espalier_query_status espalier_scene_for_each_overlap_capsule(const espalier_scene* scene,
                                                              const espalier_capsule* capsule,
                                                              espalier_scene_triangle_visitor visit, void* user,
                                                              uint32_t mask, espalier_scene_filter filter,
                                                              void* filter_user);
espalier_query_status espalier_scene_for_each_overlap_box(const espalier_scene* scene, const espalier_box* box,
                                                          espalier_scene_triangle_visitor visit, void* user,
                                                          uint32_t mask, espalier_scene_filter filter,
                                                          void* filter_user);
espalier_query_status espalier_scene_for_each_overlap_oriented_box(const espalier_scene* scene,
                                                                   const espalier_oriented_box* box,
                                                                   espalier_scene_triangle_visitor visit, void* user,
                                                                   uint32_t mask, espalier_scene_filter filter,
                                                                   void* filter_user);
espalier_query_status espalier_scene_for_each_overlap_cone(const espalier_scene* scene, const espalier_cone* cone,
                                                           espalier_scene_triangle_visitor visit, void* user,
                                                           uint32_t mask, espalier_scene_filter filter,
                                                           void* filter_user);
espalier_query_status espalier_scene_for_each_overlap_triangle(const espalier_scene* scene,
                                                               const espalier_triangle* triangle,
                                                               espalier_scene_triangle_visitor visit, void* user,
                                                               uint32_t mask, espalier_scene_filter filter,
                                                               void* filter_user);

#ifdef __cplusplus
}
#endif

#endif
