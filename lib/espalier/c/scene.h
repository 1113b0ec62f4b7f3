/* Scenes: one file with a few meshes and many instances of them, and queries over all instances. Counterpart of
 * scene.hpp.
 *
 * A tile is a scene that is an instance of another one, in place of a mesh.
 *
 * Shapes and results are in world space. Every query takes into account the instances whose mask shares a bit with
 * `mask` (UINT32_MAX for all), and of these the triangles that the filter keeps. Visitors are called in ascending order
 * of instances; for the view of a moving scene (scenes/moving_scene.h) in the order of its tree. */
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

/* The number of an instance in its scene and, if that is a tile, of one in the tile. For a mesh, and for a tile as a
 * whole, `in_tile` must be ESPALIER_NO_INSTANCE: write {i, ESPALIER_NO_INSTANCE}. */
typedef struct ESPALIER_SHARED_ espalier_instance_id {
    uint32_t index, in_tile;
} espalier_instance_id;
#define ESPALIER_NO_INSTANCE UINT32_C(0xFFFFFFFF)

/* A mesh or a tile at a place in the world. Tiles are numbered after the meshes. */
typedef struct ESPALIER_SHARED_ espalier_instance {
    espalier_transform transform;
    uint32_t mesh, mask, user, source;
} espalier_instance;

typedef struct ESPALIER_SHARED_ espalier_instance_result {
    espalier_instance value;
    espalier_query_status status;
} espalier_instance_result;

/* A mesh; it counts only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_mesh_result {
    espalier_blob value;
    espalier_query_status status;
} espalier_mesh_result;

/* A view of a baked scene: copied freely, owning nothing. The bytes and the arrays must outlive it and stay
 * unchanged. Filled with zeros it was never opened: it has no instances, and queries refuse it. Its content may
 * change. */
typedef struct ESPALIER_BLOB_ espalier_scene {
    unsigned char opaque_[sizeof(void*) == 8 ? 304 : 256];
} espalier_scene;

/* Returns the number of meshes that a scene states in its header, those of its tiles included: the size of the array
 * that espalier_open_scene() needs. Returns 0 for bytes that are no scene or too few for
 * so many. */
uint32_t espalier_scene_mesh_count(const void* bytes, size_t size);
/* Returns the number of tiles that a scene states in its header. */
uint32_t espalier_scene_tile_count(const void* bytes, size_t size);
/* Proves that every query on the bytes is safe, writes a view of them to `scene` and returns its status, which the
 * scene holds as well. `meshes` receives an open blob for each mesh, `tiles` an open scene for each tile; other
 * elements are empty. After a refusal each element is open or empty. None of them need be initialised; a
 * scene without tiles needs no array for them. At an address that is no multiple of 16 each is refused with
 * ESPALIER_OPEN_MISALIGNED, and then nothing is written; no other function may be given such an address. */
espalier_open_status espalier_open_scene(const void* bytes, size_t size, espalier_blob* meshes, size_t mesh_capacity,
                                         espalier_scene* tiles, size_t tile_capacity, espalier_scene* scene);

/* Returns ESPALIER_OPEN_OK, or why the scene is not open. */
espalier_open_status espalier_scene_status(const espalier_scene* scene);
uint32_t espalier_scene_instance_count(const espalier_scene* scene);
/* Returns the array of meshes, each an open blob, and writes their number to `count`. */
const espalier_blob* espalier_scene_meshes(const espalier_scene* scene, size_t* count);
/* Returns the array of tiles, each an open scene, and writes their number to `count`. */
const espalier_scene* espalier_scene_tiles(const espalier_scene* scene, size_t* count);
/* Returns the size in bytes, meshes and tiles included. */
uint32_t espalier_scene_size(const espalier_scene* scene);
/* Returns the largest distance between the surface of any instance and its source, in world units. */
float espalier_scene_max_error(const espalier_scene* scene);
/* Returns where 0 0 0 of the scene lies in its source, which the baker subtracted from all places; of most scenes, and
 * of a view of a moving one, 0 0 0. */
espalier_vec3d espalier_scene_source_origin(const espalier_scene* scene);
/* Returns a box around the boxes and the local origins of all instances. */
espalier_box espalier_scene_bounds(const espalier_scene* scene);
/* Returns the region that holds the instances which lie on one lattice. */
espalier_lattice_result espalier_scene_common_lattice(const espalier_scene* scene);
/* Returns an instance. */
espalier_instance_result espalier_scene_instance_at(const espalier_scene* scene, espalier_instance_id instance);
/* Returns the mesh of an instance. */
espalier_mesh_result espalier_scene_mesh_at(const espalier_scene* scene, espalier_instance_id instance);
/* Returns whether rays are rounded once for this instance and others. */
espalier_yes_no espalier_scene_is_on_common_lattice(const espalier_scene* scene, espalier_instance_id instance);

/* Returns whether a query keeps a triangle of an instance. A null filter keeps all. */
typedef bool (*espalier_scene_filter)(espalier_instance_id instance, espalier_triangle_id triangle, void* user);

/* The results of queries of a blob, in world space, with the instance. */
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

/* Returns the hit with the smallest t; of equal t the one in the lowest instance, then the lowest triangle. */
espalier_scene_ray_hit espalier_scene_raycast(const espalier_scene* scene, const espalier_ray* ray, uint32_t mask,
                                              espalier_scene_filter filter, void* user);
/* Returns the same for a ray that is rounded for a region of the caller's. Instances that lie in the region and on its
 * lattice take `rounded`, the others take `ray`. */
espalier_scene_ray_hit espalier_scene_raycast_rounded(const espalier_scene* scene, const espalier_ray* ray,
                                                      const espalier_rounded_ray* rounded, uint32_t mask,
                                                      espalier_scene_filter filter, void* user);
/* Writes to each element what the query of its ray returns. Both arrays have `count` elements. */
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
/* Calls the visitor with each hit in ascending order of instances, and of triangles within one. `user` is passed to the
 * visitor, `filter_user` to the filter. */
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

/* Returns the first contact of the shape as it moves by `displacement`. */
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

/* Selects the triangles that count, and where the shape stops. All zero, it selects all triangles and no skin. */
typedef struct ESPALIER_SHARED_ espalier_scene_sweep_options {
    espalier_scene_filter filter; /* null keeps all */
    void* user;                   /* passed to `filter` */
    float skin;                   /* in world units */
    espalier_face_culling culling;
    bool ignore_leaving;
    uint8_t reserved[2];
} espalier_scene_sweep_options;

/* Returns the first contact under some options. */
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
/* Calls the visitor with each instance whose box in the tree touches the box, in ascending order; of a tile, with each
 * instance in it whose box does. */
espalier_query_status espalier_scene_for_each_candidate(const espalier_scene* scene, const espalier_box* box,
                                                        espalier_instance_visitor visit, void* user, uint32_t mask);

/* Returns whether any triangle touches the shape. */
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
/* Visits every triangle that touches the shape, in ascending order of instances, until the visitor stops. `user` is
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
