/* Batches of rays in arrays: closest hits, any hit, the first few hits, all hits and crossings. arrays.h states what
 * every batch refuses. Counterpart of batches/rays.hpp. */
#ifndef ESPALIER_C_BATCHES_RAYS_H
#define ESPALIER_C_BATCHES_RAYS_H

#include <stddef.h>

#include <espalier/c/attributes.h>
#include <espalier/c/batches/arrays.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The fields of espalier_ray, each in an array of its own. Arrays of zeros for `t_min` and `t_max` give all rays 0 and
 * infinity. */
typedef struct ESPALIER_SHARED_ espalier_ray_arrays {
    espalier_strided_vec3 origins, directions;
    espalier_strided_float t_min, t_max;
    espalier_face_culling culling;
} espalier_ray_arrays;

/* Write what espalier_raycast() or espalier_occluded() returns for each ray. */
espalier_filled espalier_raycast_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                        espalier_ray_hit* hits, size_t count);
espalier_filled espalier_occluded_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                         espalier_yes_no* answers, size_t count);

/* Writes what espalier_closest_hits() returns for each ray to `found`, and the hits to `hits`, which has count * places
 * elements. Those of ray i begin at i * places. */
espalier_filled espalier_closest_hits_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                             espalier_ray_hit* hits, size_t places, espalier_filled* found,
                                             size_t count);

/* Write the hits of each ray in the order of espalier_for_each_hit(), or its crossings, and the status that this
 * returns to `statuses`. `hits` has `capacity` elements. */
espalier_filled_lists espalier_collect_hits_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                                   espalier_query_status* statuses, size_t* offsets, size_t count,
                                                   espalier_ray_hit* hits, size_t capacity);
espalier_filled_lists espalier_collect_crossings_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                                        espalier_query_status* statuses, size_t* offsets, size_t count,
                                                        espalier_ray_hit* crossings, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
