/* Queries that count their work. Counterpart of advanced/statistics.hpp and scenes/statistics.hpp. */
#ifndef ESPALIER_C_STATISTICS_H
#define ESPALIER_C_STATISTICS_H

#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/pair.h>
#include <espalier/c/ray.h>
#include <espalier/c/scenes/pairs.h>
#include <espalier/c/transform.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The work of queries on one blob, accumulated over calls. */
typedef struct ESPALIER_SHARED_ espalier_query_counters {
    uint64_t nodes, leaves, groups, triangles, candidates;
} espalier_query_counters;

/* Returns what espalier_raycast() returns and adds its work to the counters. */
espalier_ray_hit espalier_raycast_counted(const espalier_blob* blob, const espalier_ray* ray,
                                          espalier_query_counters* counters);

/* The work of queries on two blobs, accumulated over calls. */
typedef struct ESPALIER_SHARED_ espalier_pair_counters {
    uint64_t box_pairs, leaf_pairs, triangle_pairs;
} espalier_pair_counters;

/* Returns what espalier_first_contact() returns and adds its work to the counters. */
espalier_pair_contact espalier_first_contact_counted(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                     uint64_t work_limit, espalier_pair_counters* counters);
/* Returns what espalier_distance() returns and adds its work to the counters. */
espalier_blob_distance espalier_distance_counted(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                 uint64_t work_limit, float max_distance,
                                                 espalier_pair_counters* counters);

/* The work of searching for pairs of instances, accumulated over calls. */
typedef struct ESPALIER_SHARED_ espalier_scene_counters {
    uint64_t box_tests, pairs;
} espalier_scene_counters;

/* Returns what espalier_collect_candidate_pairs() returns and adds its work to the counters. */
espalier_filled_instance_pairs espalier_collect_candidate_pairs_counted(espalier_moving_scene* scene,
                                                                        espalier_instance_pair* pairs, size_t capacity,
                                                                        espalier_scene_counters* counters,
                                                                        const espalier_pair_filter* filter,
                                                                        espalier_instance_pair from);
/* Returns what espalier_collect_colliding_pairs() returns, and adds the work of the search to `counters` and that of
 * comparing the candidates' triangles to `of_triangles`. */
espalier_filled_instance_pairs espalier_collect_colliding_pairs_counted(
    espalier_moving_scene* scene, espalier_instance_pair* pairs, size_t capacity, uint64_t work_limit,
    espalier_scene_counters* counters, espalier_pair_counters* of_triangles, const espalier_pair_filter* filter,
    espalier_instance_pair from);

#ifdef __cplusplus
}
#endif

#endif
