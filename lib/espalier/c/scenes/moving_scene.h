/* Scenes whose instances move, in a block of memory that the caller owns. Counterpart of scenes/moving_scene.hpp.
 *
 * Instances of meshes and tiles can be inserted, moved and removed at any time. A simulation step moves many instances
 * with one call of espalier_moving_scene_move_batch() and then calls espalier_moving_scene_refit(). The block contains
 * no pointers: a copy of its bytes is a snapshot, which espalier_open_moving_scene() opens.
 *
 * The queries are those of scene.h: espalier_moving_scene_view() makes the espalier_scene that they take.
 *
 * Threads. Any number of threads may query a scene while no thread changes it. */
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

/* Identifies an instance of a moving scene from its insertion to its removal. Afterwards the handle is stale, and calls
 * refuse it with ESPALIER_QUERY_STALE_HANDLE. Filled with zeros, it names no instance. */
typedef struct ESPALIER_SHARED_ espalier_instance_handle {
    uint32_t slot; /* espalier_instance_id.index in the results of queries; reused after a removal */
    uint32_t generation;
} espalier_instance_handle;

/* The value is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_instance_handle_result {
    espalier_instance_handle value;
    espalier_query_status status;
} espalier_instance_handle_result;
typedef struct ESPALIER_SHARED_ espalier_box_result {
    espalier_box value;
    espalier_query_status status;
} espalier_box_result;

/* An instance and where it moves. */
typedef struct ESPALIER_SHARED_ espalier_movement {
    espalier_instance_handle instance;
    espalier_transform transform;
} espalier_movement;

/* A view of a block and of the meshes and tiles that its instances use. It can be copied freely and owns nothing; the
 * block and the arrays must outlive it. Filled with zeros, it is not open, and calls refuse it. Its content may change
 * from version to version. */
typedef struct ESPALIER_SHARED_ espalier_moving_scene {
    void* opaque_[3];
    uint32_t opaque_counts_[2];
    int32_t opaque_origin_[3];
} espalier_moving_scene;

/* Returns the size of a block for so many instances, in bytes, and 0 unless `instances` is 1 .. 2^24. No order of
 * insertions and removals needs more. posix_memalign(&block, 32, (size_t)size) returns suitable memory; malloc() aligns
 * less. */
uint64_t espalier_moving_scene_bytes(uint32_t instances);
/* Returns the fewest bytes that espalier_create_moving_scene() accepts. If such a block runs out of nodes, an insertion
 * repacks the tree. */
uint64_t espalier_least_moving_scene_bytes(uint32_t instances);

/* Creates an empty scene in memory whose address is a multiple of 32, writes a view of it to `scene`, and returns
 * whether the scene is open. It is not open, and `scene` is empty, if an argument is out of range, if the memory is
 * misaligned or smaller than espalier_least_moving_scene_bytes(), or if a tile is the view of a moving scene. The scene
 * refers to both arrays, which must outlive it. Their elements need not be open: espalier_moving_scene_insert() refuses
 * those that are not.
 *
 * A step of the world is 2^step_exponent long, -100 .. 80. Tiles are numbered after the meshes. A misaligned `scene` is
 * refused too, and then nothing is written; do not pass such an address to any other function. */
bool espalier_create_moving_scene(void* memory, size_t size, uint32_t capacity, int step_exponent,
                                  const espalier_blob* meshes, size_t mesh_count, const espalier_scene* tiles,
                                  size_t tile_count, espalier_moving_scene* scene);
/* Proves that every call on a snapshot is safe, writes a view of it to `scene`, and returns whether the scene is open.
 * It is not if its bytes contradict each other, or if an instance would have another box with these meshes and tiles.
 * Takes any bytes at an address that is a multiple of 32, and ignores those after the block. Refuses what
 * espalier_create_moving_scene() refuses.
 *
 * Other meshes with equal bounds and lattice steps pass. Nor is this a checksum: a different mask, user word or
 * generation is as valid as the original. */
bool espalier_open_moving_scene(void* snapshot, size_t size, const espalier_blob* meshes, size_t mesh_count,
                                const espalier_scene* tiles, size_t tile_count, espalier_moving_scene* scene);

bool espalier_moving_scene_is_open(const espalier_moving_scene* scene);
uint32_t espalier_moving_scene_instance_count(const espalier_moving_scene* scene);
/* Returns the number of instances that the block has room for. */
uint32_t espalier_moving_scene_capacity(const espalier_moving_scene* scene);
/* Returns a number above every slot that was ever used, for loops over all slots. */
uint32_t espalier_moving_scene_slot_end(const espalier_moving_scene* scene);
/* Returns the exponent e of the world's step, which is 2^e long. */
int espalier_moving_scene_step_exponent(const espalier_moving_scene* scene);
/* Returns the position in the world from which this view counts coordinates, a multiple of 128 steps along each axis.
 * To pass a position to the view, subtract the origin in float64 and round the difference to float32; to an answer, add
 * the origin in float64. It is 0 unless espalier_moving_scene_seen_from() made the view. */
espalier_vec3d espalier_moving_scene_origin(const espalier_moving_scene* scene);
/* Returns the region for which rays are rounded once. It serves instances whose transforms do nothing but translate by
 * whole steps of the world, and whose meshes have a lattice with that step; for a tile, its own common lattice counts.
 * No ray slips between two of them that share an edge. The status is ESPALIER_QUERY_NOT_FOUND until there has been such
 * an instance.
 *
 * The region is a cube around the origin of the view that extends 2^17 steps to each side. When such an instance is
 * inserted or moved beyond it, the region doubles until it contains the instance, up to 2^23 steps, and it never
 * shrinks. An instance beyond that rounds rays for itself. In a view with an origin other than 0, and in a scene with
 * instances that were inserted or moved through one, there is always a region, and it extends 2^23 steps. */
espalier_lattice_result espalier_moving_scene_common_lattice(const espalier_moving_scene* scene);
/* Returns whether a batch has moved instances since the last refit. Queries are then refused with
 * ESPALIER_QUERY_NOT_REFITTED. */
bool espalier_moving_scene_must_refit(const espalier_moving_scene* scene);
/* Returns the block, for taking a snapshot, and writes its size in bytes to `size`, which is at most that of the
 * memory. Memory that receives a copy must have room for it, as does a block that was created with the same size. */
const void* espalier_moving_scene_block(const espalier_moving_scene* scene, size_t* size);
/* Return the array of meshes or tiles, and write their number to `count`. */
const espalier_blob* espalier_moving_scene_meshes(const espalier_moving_scene* scene, size_t* count);
const espalier_scene* espalier_moving_scene_tiles(const espalier_moving_scene* scene, size_t* count);

/* Writes a view of the same block whose origin is, along each axis, the multiple of 128 steps nearest to a position in
 * the world. Returns false for a position that is not finite or is 2^30 - 64 steps or more from 0, for a scene that is
 * not open, and for misaligned memory; `view` is then empty, or not written if it is misaligned. Changes nothing: any
 * number of views may be in use. O(1).
 *
 * An instance that is inserted or moved through a view keeps its position exactly, and views from elsewhere round its
 * translation once to float32: a world of 100 km thus has a resolution of millimetres near each view. Relative to the
 * origin are the shapes and answers of queries; transforms that are inserted, moved or returned; boxes; the common
 * lattice; and a baked scene in pairs with this one. Handles, the bounds of the world and pairs do not depend on it. A
 * view places nothing farther than 2^30 - 128 steps from its origin (ESPALIER_QUERY_OUT_OF_RANGE). */
bool espalier_moving_scene_seen_from(const espalier_moving_scene* scene, espalier_vec3d place,
                                     espalier_moving_scene* view);

/* Inserts an instance; its `source` is not stored. It takes the most recently removed slot that is still free, or else
 * the lowest that was never used. A refusal changes nothing: ESPALIER_QUERY_INVALID_ARGUMENT for an index that belongs
 * to no mesh or tile, a mesh or tile that cannot be placed, or a transform that is not valid;
 * ESPALIER_QUERY_OUT_OF_RANGE for a position outside the world; ESPALIER_QUERY_NO_ROOM for a full scene. */
espalier_instance_handle_result espalier_moving_scene_insert(espalier_moving_scene* scene,
                                                             const espalier_instance* instance);
/* Removes an instance. */
espalier_query_status espalier_moving_scene_remove(espalier_moving_scene* scene, espalier_instance_handle instance);
/* Moves an instance. If this is refused, the instance stays where it is. */
espalier_query_status espalier_moving_scene_move(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                 const espalier_transform* transform);
/* Moves instances one after the other; espalier_moving_scene_refit() must follow before the next query. Stops at the
 * first movement that is refused: `count` of the result is then its index, and those before it are done. Until the
 * refit or a call of espalier_moving_scene_repack(), queries and pairs are refused, while every other call still
 * works. */
espalier_filled espalier_moving_scene_move_batch(espalier_moving_scene* scene, const espalier_movement* movements,
                                                 size_t count);
/* Updates the boxes of all instances of a mesh whose vertices moved (espalier_deformable_refit());
 * espalier_moving_scene_refit() must follow before the next query. Until this call, queries may miss the mesh; after
 * it, they are refused until the refit. Refuses an index that belongs to no mesh (ESPALIER_QUERY_INVALID_ARGUMENT), and
 * a pose that leaves the world where an instance is (ESPALIER_QUERY_OUT_OF_RANGE). A refusal changes nothing. */
espalier_query_status espalier_moving_scene_move_instances_of(espalier_moving_scene* scene, uint32_t mesh);
/* Changes the mask by which queries and pairs select an instance. */
espalier_query_status espalier_moving_scene_set_mask(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                     uint32_t mask);
/* Changes the user word of an instance. */
espalier_query_status espalier_moving_scene_set_user(espalier_moving_scene* scene, espalier_instance_handle instance,
                                                     uint32_t user);

/* Updates the boxes of the tree above the instances that a batch moved. Returns the number of nodes updated. */
uint32_t espalier_moving_scene_refit(espalier_moving_scene* scene);
/* Rebuilds the tree. Call it every few steps, or when the quality has risen. Includes the refit. */
void espalier_moving_scene_repack(espalier_moving_scene* scene);
/* Returns how much the surface of the tree's boxes has grown, per instance, since the last repack; from 1.3 on a repack
 * is worthwhile. The value is below 1 if instances have moved closer together, INFINITY before the first repack, and 1
 * without instances. */
float espalier_moving_scene_quality(const espalier_moving_scene* scene);
/* Ends a step: no instance counts as moved until it is moved or inserted again (scenes/pairs.h). */
void espalier_moving_scene_end_step(espalier_moving_scene* scene);

/* Returns the handle of the instance in a slot. Refuses a slot that is free (ESPALIER_QUERY_NOT_FOUND) or was never
 * used (ESPALIER_QUERY_OUT_OF_RANGE). */
espalier_instance_handle_result espalier_moving_scene_handle_of(const espalier_moving_scene* scene, uint32_t slot);
/* Returns an instance, whose `source` is its slot. */
espalier_instance_result espalier_moving_scene_instance_at(const espalier_moving_scene* scene,
                                                           espalier_instance_handle instance);
/* Returns the instance that a result or a pair names, which is the one in the slot `index`. With `in_tile` it is an
 * instance in the tile of that slot: its transform leads to the tile's local space, and its mesh is one of the tile's.
 * Refuses a slot as espalier_moving_scene_handle_of() does, and an instance that the slot's tile does not have
 * (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_instance_result espalier_moving_scene_instance_of_id(const espalier_moving_scene* scene,
                                                              espalier_instance_id instance);
/* Returns whether an instance lies in the common region and on its lattice. With `in_tile`, this must hold for both the
 * tile and the instance in it. Refuses what espalier_moving_scene_instance_of_id() refuses. */
espalier_yes_no espalier_moving_scene_is_on_common_lattice(const espalier_moving_scene* scene,
                                                           espalier_instance_id instance);
/* Returns the box of an instance in the tree, rounded outward to float. */
espalier_box_result espalier_moving_scene_box_of(const espalier_moving_scene* scene, espalier_instance_handle instance);

/* Writes the scene that queries of scene.h take, and returns ESPALIER_QUERY_OK, or why they will refuse it:
 * ESPALIER_QUERY_NOT_OPEN or ESPALIER_QUERY_NOT_REFITTED. A misaligned `view` is refused with
 * ESPALIER_QUERY_INVALID_ARGUMENT, and then nothing is written. O(1).
 *
 * A view is valid until the next change of the moving scene or of a copy of it, so make one for the queries between two
 * changes and never use an older one. In results, espalier_instance_id.index is a slot, and
 * espalier_moving_scene_instance_of_id() returns the instance. Visitors are called in the order of the tree, which is
 * the same on every machine, rather than in ascending order of slots.
 *
 * Other functions of scene.h take a view too: espalier_scene_instance_at(), espalier_scene_mesh_at() and
 * espalier_scene_is_on_common_lattice() refuse it with ESPALIER_QUERY_INVALID_ARGUMENT. The size is 0 and the
 * largest error is INFINITY, because neither is stored. espalier_scene_common_lattice() returns what
 * espalier_moving_scene_common_lattice() returns, and espalier_scene_bounds() a box around the boxes of all
 * instances. */
espalier_query_status espalier_moving_scene_view(const espalier_moving_scene* scene, espalier_scene* view);

#ifdef __cplusplus
}
#endif

#endif
