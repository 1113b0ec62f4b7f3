/* Pairs of instances that may touch, or do: of a moving scene with itself, and with a baked scene in the same world.
 * Counterpart of scenes/pairs.hpp.
 *
 * A candidate pair is one whose boxes touch; a colliding pair also has triangles that touch. Pairs are written in
 * ascending order, in pages. The first page begins at a pair that is filled with zeros, each other one at `next` of the
 * page before it. Both instances of a pair have masks that share a bit.
 *
 * Threads. The pairs of a scene with itself use its block for sorting: no other thread may use that scene meanwhile. */
#ifndef ESPALIER_C_SCENES_PAIRS_H
#define ESPALIER_C_SCENES_PAIRS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/scenes/moving_scene.h>
#include <espalier/c/scene.h>
#include <espalier/c/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Two instances of a moving scene, by their slots: a < b. */
typedef struct ESPALIER_SHARED_ espalier_instance_pair {
    uint32_t a, b;
} espalier_instance_pair;

/* An instance of a moving scene, by its slot, and one of a baked scene. Behind a pair come those from
 * {moving, {index + 1, 0}} on if `in_tile` is 0xFFFFFFFF, as that of a mesh is, else from
 * {moving, {index, in_tile + 1}} on. */
typedef struct ESPALIER_SHARED_ espalier_baked_pair {
    uint32_t moving;
    espalier_instance_id baked;
} espalier_baked_pair;

/* Returns whether a pair is kept. The second instance is that of the baked scene, if there is one. It is called more
 * than once for some pairs and must return the same each time. It may read instances of the scenes and query them; it
 * must not change the moving scene or collect pairs of it with itself. */
typedef bool (*espalier_pair_keep)(espalier_instance_id a, espalier_instance_id b, void* user);

/* The pairs that a query returns. Filled with zeros, or null, it keeps all. */
typedef struct ESPALIER_SHARED_ espalier_pair_filter {
    bool only_moved;         /* only pairs of which an instance was moved or inserted in this step */
    espalier_pair_keep keep; /* null keeps all */
    void* user;              /* passed to `keep` */
} espalier_pair_filter;

/* A page of pairs: how many were written, and where to resume after ESPALIER_QUERY_OUTPUT_FULL and
 * ESPALIER_QUERY_WORK_LIMIT, when there may be more. After ESPALIER_QUERY_OUT_OF_RANGE `next` is the pair that was
 * refused. Otherwise ESPALIER_QUERY_OK, or why the query was refused. */
typedef struct ESPALIER_SHARED_ espalier_filled_instance_pairs {
    size_t count;
    espalier_instance_pair next;
    espalier_query_status status;
} espalier_filled_instance_pairs;
typedef struct ESPALIER_SHARED_ espalier_filled_baked_pairs {
    size_t count;
    espalier_baked_pair next;
    espalier_query_status status;
} espalier_filled_baked_pairs;

/* Writes the pairs of instances whose boxes touch, from the pair `from` on. Refuses a scene that is not open
 * (ESPALIER_QUERY_NOT_OPEN) or waits for a refit (ESPALIER_QUERY_NOT_REFITTED). An array without
 * room gets none of the pairs: enlarge it before the next call. A first page with room for all pairs takes one walk of
 * the tree, every other page one from each of its slots. */
espalier_filled_instance_pairs espalier_collect_candidate_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                const espalier_pair_filter* filter,
                                                                espalier_instance_pair from);
/* Writes the candidate pairs of which triangles touch. `work_limit` is the work of all pairs together, as that of
 * espalier_overlaps_blob() in pair.h, which also defines ESPALIER_WORK_UNLIMITED. If a page ends with
 * ESPALIER_QUERY_WORK_LIMIT and `next` equals `from`, the limit is too small for that pair. Stops with
 * ESPALIER_QUERY_OUT_OF_RANGE at a pair that is refused: `next` is that pair, and {next.a, next.b + 1} is behind it. */
espalier_filled_instance_pairs espalier_collect_colliding_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                uint64_t work_limit, const espalier_pair_filter* filter,
                                                                espalier_instance_pair from);

/* Writes the pairs of an instance of the moving scene and one of the baked scene. One with an origin needs a view that
 * counts from there (espalier_moving_scene_seen_from). Refuses other views, and also the view of a moving scene in
 * place of a baked one (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_filled_baked_pairs espalier_collect_candidate_pairs_with_baked(const espalier_moving_scene* moving,
                                                                        const espalier_scene* baked,
                                                                        espalier_baked_pair* pairs, size_t capacity,
                                                                        const espalier_pair_filter* filter,
                                                                        espalier_baked_pair from);
/* Writes those of which triangles touch. The limit and a refused pair are as above; espalier_baked_pair describes what
 * is behind a pair. */
espalier_filled_baked_pairs espalier_collect_colliding_pairs_with_baked(
    const espalier_moving_scene* moving, const espalier_scene* baked, espalier_baked_pair* pairs, size_t capacity,
    uint64_t work_limit, const espalier_pair_filter* filter, espalier_baked_pair from);

#ifdef __cplusplus
}
#endif

#endif
