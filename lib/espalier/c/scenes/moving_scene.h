/* Scenes whose instances move, in a block of memory that the caller owns. Counterpart of scenes/moving_scene.hpp.
 *
 * Instances of meshes and tiles are inserted, moved and removed at any time. A step of a simulation moves many
 * instances by one call of espalier_moving_scene_move_batch() and then calls espalier_moving_scene_refit(). The block
 * has no pointers: a copy of its bytes is a snapshot, with which espalier_open_moving_scene() continues.
 *
 * The queries are those of scene.h: espalier_moving_scene_view() makes the espalier_scene that they take.
 *
 * Threads. Any number of threads may query a scene that no thread changes. */
#ifndef ESPALIER_C_SCENES_MOVING_SCENE_H
#define ESPALIER_C_SCENES_MOVING_SCENE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/scene.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/transform.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The name of an instance of a moving scene, from its insertion to its removal. Afterwards it is stale and is refused
 * with ESPALIER_QUERY_STALE_HANDLE. Filled with zeros it names no instance. */
typedef struct ESPALIER_SHARED_ espalier_instance_handle {
    uint32_t slot; /* espalier_instance_id.index of the results of queries; used again after a removal */
    uint32_t generation;
} espalier_instance_handle;

/* The value counts only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_instance_handle_result {
    espalier_instance_handle value;
    espalier_query_status status;
} espalier_instance_handle_result;
typedef struct ESPALIER_SHARED_ espalier_box_result {
    espalier_box value;
    espalier_query_status status;
} espalier_box_result;

/* An instance and the place that it moves to. */
typedef struct ESPALIER_SHARED_ espalier_movement {
    espalier_instance_handle instance;
    espalier_transform transform;
} espalier_movement;

/* A view of a block, and of the meshes and tiles that its instances place: copied freely, owning nothing. The block and
 * the arrays must outlive it. Filled with zeros it is not open, and calls refuse it. Its content may change. */
typedef struct ESPALIER_SHARED_ espalier_moving_scene {
    void* opaque_[3];
    uint32_t opaque_counts_[2];
    int32_t opaque_origin_[3];
} espalier_moving_scene;

/* Returns the bytes of a block for so many instances, 1 .. 2^24, else 0. No order of insertions and removals needs
 * more. posix_memalign(&block, 32, (size_t)size) returns such memory: malloc() aligns less. */
uint64_t espalier_moving_scene_bytes(uint32_t instances);
/* Returns the fewest bytes that espalier_create_moving_scene() accepts. When nodes run out in such a block, an
 * insertion repacks the tree. */
uint64_t espalier_least_moving_scene_bytes(uint32_t instances);

/* Makes an empty scene in memory whose address is a multiple of 32, and writes a view of it to `scene`. Returns whether
 * the scene is open: not if an argument is out of its range, if the memory is misaligned or smaller than
 * espalier_least_moving_scene_bytes(), or if a tile is the view of a moving scene. `scene` is then empty.
 * The scene refers to both arrays, which must outlive it. Their elements need not be open:
 * espalier_moving_scene_insert() refuses those that are not.
 *
 * A step of the world is 2^step_exponent long, -100 .. 80. Tiles are numbered after the meshes. A misaligned `scene` is
 * refused too, and then nothing is written; no other function may be given such an address. */
bool espalier_create_moving_scene(void* memory, size_t size, uint32_t capacity, int step_exponent,
                                  const espalier_blob* meshes, size_t mesh_count, const espalier_scene* tiles,
                                  size_t tile_count, espalier_moving_scene* scene);
/* Proves that every call on a snapshot is safe, and writes a view of it to `scene`. Returns whether the scene is open:
 * not if a byte contradicts the others, or if an instance has another box with these meshes and tiles. Takes any bytes,
 * at an address that is a multiple of 32, and ignores those behind the block. Refuses what
 * espalier_create_moving_scene() refuses. Other meshes with equal bounds and lattice steps pass.
 * It is no checksum: another mask, user word or generation is as valid as the one before. */
bool espalier_open_moving_scene(void* snapshot, size_t size, const espalier_blob* meshes, size_t mesh_count,
                                const espalier_scene* tiles, size_t tile_count, espalier_moving_scene* scene);

bool espalier_moving_scene_is_open(const espalier_moving_scene* scene);
uint32_t espalier_moving_scene_instance_count(const espalier_moving_scene* scene);
/* Returns the number of instances that there is room for. */
uint32_t espalier_moving_scene_capacity(const espalier_moving_scene* scene);
/* Returns a number above each slot that was ever used: for loops over all slots. */
uint32_t espalier_moving_scene_slot_end(const espalier_moving_scene* scene);
/* Returns e; a step of the world is 2^e long. */
int espalier_moving_scene_step_exponent(const espalier_moving_scene* scene);
/* Returns the place in the world from which this view counts coordinates: a multiple of 128 steps on each axis. To give
 * a place to the view, subtract the origin in float64 and round the difference to float32; to an answer, add it in
 * float64. 0 unless espalier_moving_scene_seen_from() made the view. */
espalier_vec3d espalier_moving_scene_origin(const espalier_moving_scene* scene);
/* Returns the region for which rays are rounded once: for instances whose transforms move by whole steps of the world
 * and do nothing else, and whose meshes have a lattice with that step. For a tile, its own common lattice counts. No
 * ray passes between two of them that share an edge. ESPALIER_QUERY_NOT_FOUND until there has been one.
 *
 * The region is a cube around the origin of the view, which reaches 2^17 steps to each side. It doubles until it holds
 * such an instance that is inserted or moved beyond, up to 2^23 steps, and never shrinks. An instance beyond that
 * rounds rays for itself. In a view from another origin than 0, and in a scene with instances that were inserted or
 * moved through one, there is always a region, whose cube reaches 2^23 steps. */
espalier_lattice_result espalier_moving_scene_common_lattice(const espalier_moving_scene* scene);
/* Returns whether a batch has moved instances since the last refit: queries are then refused with
 * ESPALIER_QUERY_NOT_REFITTED. */
bool espalier_moving_scene_must_refit(const espalier_moving_scene* scene);
/* Returns the block, which a snapshot copies, and writes its size in bytes to `size`: at most that of the memory.
 * Memory that a copy is written to needs room for it, as a block that was made with the same size has. */
const void* espalier_moving_scene_block(const espalier_moving_scene* scene, size_t* size);
/* Returns the array of meshes or tiles, and writes their number to `count`. */
const espalier_blob* espalier_moving_scene_meshes(const espalier_moving_scene* scene, size_t* count);
const espalier_scene* espalier_moving_scene_tiles(const espalier_moving_scene* scene, size_t* count);

/* Writes a view of the same block whose origin is the multiple of 128 steps that is nearest to a place in the world, on
 * each axis. Returns false for a place that is not finite or 2^30 - 64 steps or more from 0, for a scene that is not
 * open, or for misaligned memory; `view` is then empty, or not written if it is misaligned. Changes nothing: any number
 * of views may be in use. O(1).
 *
 * An instance that is inserted or moved through a view keeps its place exactly, and views from elsewhere round its
 * translation once to float32: so a world of 100 km has millimetres near each view. What counts from the origin: shapes
 * and answers of queries, transforms that are inserted, moved and returned, boxes, the common lattice, and a baked
 * scene in pairs with this one. Handles, the bounds of the world and pairs do not depend on it. A view places nothing
 * farther than 2^30 - 128 steps from its origin (ESPALIER_QUERY_OUT_OF_RANGE). */
bool espalier_moving_scene_seen_from(const espalier_moving_scene* scene, espalier_vec3d place,
                                     espalier_moving_scene* view);

/* Inserts an instance; its `source` is not stored. It takes the slot of the latest removal that is still free, else the
 * lowest that was never used. A refusal changes nothing: ESPALIER_QUERY_INVALID_ARGUMENT for a
 * number that belongs to no mesh, a mesh or tile that cannot be placed, or a transform that is not valid;
 * ESPALIER_QUERY_OUT_OF_RANGE for a place outside of the world; ESPALIER_QUERY_NO_ROOM in a full scene. */
espalier_instance_handle_result espalier_moving_scene_insert(espalier_moving_scene* scene,
                                                             const espalier_instance* instance);
/* Removes an instance. */
espalier_query_status espalier_moving_scene_remove(espalier_moving_scene* scene, espalier_instance_handle instance);
/* Moves an instance. A refused one stays where it is. */
espalier_query_status espalier_moving_scene_move(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                 const espalier_transform* transform);
/* Moves instances, one after the other; espalier_moving_scene_refit() must follow before the next query. Stops at the
 * first that is refused, and `count` of the result is its index; those before it are moved. Until the refit or a call
 * of espalier_moving_scene_repack(), queries and pairs are refused, and every other call goes on. */
espalier_filled espalier_moving_scene_move_batch(espalier_moving_scene* scene, const espalier_movement* movements,
                                                 size_t count);
/* Renews the boxes of all instances of a mesh whose vertices moved (espalier_deformable_refit()), at the places that
 * they have; espalier_moving_scene_refit() must follow before the next query. Before this call, queries may miss
 * the mesh; after it they are refused until then. Refuses a number that belongs to no mesh
 * (ESPALIER_QUERY_INVALID_ARGUMENT), and a pose that leaves the world at the place of an instance
 * (ESPALIER_QUERY_OUT_OF_RANGE); a refusal changes nothing. */
espalier_query_status espalier_moving_scene_move_instances_of(espalier_moving_scene* scene, uint32_t mesh);
/* Changes what queries and pairs select an instance by. */
espalier_query_status espalier_moving_scene_set_mask(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                     uint32_t mask);
/* Changes the caller's word of an instance. */
espalier_query_status espalier_moving_scene_set_user(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                     uint32_t user);

/* Renews the boxes of the tree above instances that a batch has moved. Returns how many nodes it renewed. */
uint32_t espalier_moving_scene_refit(espalier_moving_scene* scene);
/* Builds the tree anew: call it every few steps, or when the quality has risen. Includes the refit. */
void espalier_moving_scene_repack(espalier_moving_scene* scene);
/* Returns how much more surface the boxes of the tree have, for each instance, than after the last repack: 1.3 and more
 * is worth a repack. Below 1 if instances have come closer together since. INFINITY before the first one; 1 without
 * instances. */
float espalier_moving_scene_quality(const espalier_moving_scene* scene);
/* Ends a step: no instance counts as moved until it is moved or inserted again (scenes/pairs.h). */
void espalier_moving_scene_end_step(espalier_moving_scene* scene);

/* Returns the handle of the instance in a slot. Refuses a slot that is free (ESPALIER_QUERY_NOT_FOUND) or never was
 * used (ESPALIER_QUERY_OUT_OF_RANGE). */
espalier_instance_handle_result espalier_moving_scene_handle_of(const espalier_moving_scene* scene, uint32_t slot);
/* Returns an instance; `source` is its slot. */
espalier_instance_result espalier_moving_scene_instance_at(const espalier_moving_scene* scene,
                                                           espalier_instance_handle instance);
/* Returns the instance that a result or a pair names: that in the slot `index`. With `in_tile` it is the one in the
 * tile of that slot, whose transform leads to the tile's local space and whose mesh is one of the tile's. Refuses a
 * slot as espalier_moving_scene_handle_of() does, and an instance that the slot's tile does not have
 * (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_instance_result espalier_moving_scene_instance_of_id(const espalier_moving_scene* scene,
                                                              espalier_instance_id instance);
/* Returns whether an instance lies in that region and on its lattice. With `in_tile`, both the tile and the instance in
 * it must. Refuses what espalier_moving_scene_instance_of_id() refuses. */
espalier_yes_no espalier_moving_scene_is_on_common_lattice(const espalier_moving_scene* scene,
                                                           espalier_instance_id instance);
/* Returns the box of an instance in the tree, rounded outward to float. */
espalier_box_result espalier_moving_scene_box_of(const espalier_moving_scene* scene, espalier_instance_handle instance);

/* Writes the scene that queries of scene.h take, and returns ESPALIER_QUERY_OK, or why they will refuse it:
 * ESPALIER_QUERY_NOT_OPEN or ESPALIER_QUERY_NOT_REFITTED. A misaligned `view` is refused with
 * ESPALIER_QUERY_INVALID_ARGUMENT, and then nothing is written. O(1).
 *
 * A view is valid until the next change of the moving scene or of a copy of it: make one for the queries between two
 * changes. An older one must not be used. Of a result, espalier_instance_id.index is a slot, and
 * espalier_moving_scene_instance_of_id() returns the instance. Visitors are called in the order of the tree, which is
 * the same on every machine, and not in ascending order of slots.
 *
 * Functions of scene.h other than queries: espalier_scene_instance_at(), espalier_scene_mesh_at() and
 * espalier_scene_is_on_common_lattice() refuse a view with ESPALIER_QUERY_INVALID_ARGUMENT. The size is 0, and the
 * largest error is INFINITY, because neither is stored. espalier_scene_common_lattice() returns what
 * espalier_moving_scene_common_lattice() returns, and espalier_scene_bounds() a box around the boxes of all
 * instances. */
espalier_query_status espalier_moving_scene_view(const espalier_moving_scene* scene, espalier_scene* view);

#ifdef __cplusplus
}
#endif

#endif
