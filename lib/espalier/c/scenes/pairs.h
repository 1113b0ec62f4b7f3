/* Pairs of instances that may touch or do touch, within a moving scene or between it and a baked scene in the same
 * world. Counterpart of scenes/pairs.hpp.
 *
 * Two instances are a candidate pair if their boxes touch, and a colliding pair if their triangles touch as well. Only
 * pairs whose masks share a bit are written. They come in ascending order and in pages: the first page begins at a pair
 * of zeros, each other one at the `next` of the previous page.
 *
 * Threads. Finding pairs within a scene uses its block for sorting, so no other thread may use that scene meanwhile. */
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

/* Two instances of a moving scene, given by their slots, where a < b. */
typedef struct ESPALIER_SHARED_ espalier_instance_pair {
    uint32_t a, b;
} espalier_instance_pair;

/* An instance of a moving scene, given by its slot, and one of a baked scene. To resume after a pair, begin at
 * {moving, {index + 1, 0}} if its `in_tile` is 0xFFFFFFFF, as it is for a mesh, and otherwise at {moving, {index,
 * in_tile + 1}}. */
typedef struct ESPALIER_SHARED_ espalier_baked_pair {
    uint32_t moving;
    espalier_instance_id baked;
} espalier_baked_pair;

/* Returns whether to keep a pair. The second instance is that of the baked scene, if there is one. The function may be
 * called more than once for a pair and must return the same each time. It may read and query the scenes, but must
 * neither change the moving scene nor collect pairs within it. */
typedef bool (*espalier_pair_keep)(espalier_instance_id a, espalier_instance_id b, void* user);

/* Selects the pairs that a query returns. Filled with zeros, or null, it keeps all. */
typedef struct ESPALIER_SHARED_ espalier_pair_filter {
    bool only_moved;         /* only pairs with an instance that was moved or inserted in this step */
    espalier_pair_keep keep; /* null keeps all pairs */
    void* user;              /* passed to `keep` */
} espalier_pair_filter;

/* A page of pairs: how many were written, and where to resume after ESPALIER_QUERY_OUTPUT_FULL and
 * ESPALIER_QUERY_WORK_LIMIT, when there may be more. After ESPALIER_QUERY_OUT_OF_RANGE, `next` is the refused pair. Any
 * other status is ESPALIER_QUERY_OK or tells why the query was refused. */
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
 * (ESPALIER_QUERY_NOT_OPEN) or waits for a refit (ESPALIER_QUERY_NOT_REFITTED). An array without room receives none of
 * the pairs: enlarge it before the next call. A first page with room for all pairs traverses the tree once; every other
 * page traverses it once for each of its slots. */
espalier_filled_instance_pairs espalier_collect_candidate_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                const espalier_pair_filter* filter,
                                                                espalier_instance_pair from);
/* Writes the candidate pairs whose triangles touch. `work_limit` bounds the work of all pairs together and counts like
 * that of espalier_overlaps_blob() in pair.h, which also defines ESPALIER_WORK_UNLIMITED. If a page ends with
 * ESPALIER_QUERY_WORK_LIMIT and `next` equals `from`, the limit is too small for that pair. At a pair that is refused,
 * the page ends with ESPALIER_QUERY_OUT_OF_RANGE: `next` is that pair, and {next.a, next.b + 1} resumes after it. */
espalier_filled_instance_pairs espalier_collect_colliding_pairs(espalier_moving_scene* scene,
                                                                espalier_instance_pair* pairs, size_t capacity,
                                                                uint64_t work_limit, const espalier_pair_filter* filter,
                                                                espalier_instance_pair from);

/* Writes the pairs of an instance of the moving scene and an instance of the baked scene. If the baked scene has an
 * origin, the view must count from there (espalier_moving_scene_seen_from). Refuses other views, and the view of a
 * moving scene in place of a baked one (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_filled_baked_pairs espalier_collect_candidate_pairs_with_baked(const espalier_moving_scene* moving,
                                                                        const espalier_scene* baked,
                                                                        espalier_baked_pair* pairs, size_t capacity,
                                                                        const espalier_pair_filter* filter,
                                                                        espalier_baked_pair from);
/* Writes those of these pairs whose triangles touch. The limit and refused pairs are as above; to resume after a pair,
 * see espalier_baked_pair. */
espalier_filled_baked_pairs espalier_collect_colliding_pairs_with_baked(
    const espalier_moving_scene* moving, const espalier_scene* baked, espalier_baked_pair* pairs, size_t capacity,
    uint64_t work_limit, const espalier_pair_filter* filter, espalier_baked_pair from);

#ifdef __cplusplus
}
#endif

#endif
