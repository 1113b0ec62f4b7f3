/* Ray queries: the closest hit, any hit, the first few hits, all hits, and batches of rays. Counterpart of ray.hpp. */
#ifndef ESPALIER_C_RAY_H
#define ESPALIER_C_RAY_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The points origin + t * direction for t_min <= t <= t_max. */
typedef struct ESPALIER_SHARED_ espalier_ray {
    espalier_vec3 origin;
    espalier_vec3 direction;
    float t_min;
    float t_max; /* INFINITY for a ray without an end; 0, as in a structure of zeros, ends it at the origin */
    espalier_face_culling culling;
} espalier_ray;

/* Where a ray hits a triangle, if the status is ESPALIER_QUERY_OK; otherwise t is infinite and the triangle is
 * ESPALIER_NO_TRIANGLE. */
typedef struct ESPALIER_SHARED_ espalier_ray_hit {
    float t, u, v;
    espalier_vec3 normal;
    espalier_triangle_id triangle;
    espalier_query_status status;
    espalier_side side;
    uint8_t reserved[2];
} espalier_ray_hit;

/* Returns a ray with the defaults of the C++ structure: it has no end and hits both sides of triangles. */
espalier_ray espalier_default_ray(espalier_vec3 origin, espalier_vec3 direction);
/* Returns the ray from one point to another, along which t runs from 0 to 1. */
espalier_ray espalier_ray_between(espalier_vec3 from, espalier_vec3 to);

/* Return the hit with the smallest t. If several hits have the same t, the lowest triangle wins. With a filter, the
 * query behaves as if the blob held only the triangles that the filter keeps. */
espalier_ray_hit espalier_raycast(const espalier_blob* blob, const espalier_ray* ray);
espalier_ray_hit espalier_raycast_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                           espalier_triangle_filter filter, void* user);
/* Return whether the ray hits any triangle, in less time than espalier_raycast(). */
espalier_yes_no espalier_occluded(const espalier_blob* blob, const espalier_ray* ray);
espalier_yes_no espalier_occluded_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                           espalier_triangle_filter filter, void* user);

/* Write the first hits along the ray, sorted by t, up to `capacity`. */
espalier_filled espalier_closest_hits(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hits,
                                      size_t capacity);
espalier_filled espalier_closest_hits_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                               espalier_ray_hit* hits, size_t capacity, espalier_triangle_filter filter,
                                               void* user);

typedef espalier_visit (*espalier_hit_visitor)(const espalier_ray_hit* hit, void* user);
/* Calls the visitor once for each hit, in ascending order of triangles rather than of t. */
espalier_query_status espalier_for_each_hit(const espalier_blob* blob, const espalier_ray* ray,
                                            espalier_hit_visitor visit, void* user);

/* Calls the visitor once for each crossing of the surface, even where the ray meets a shared edge or vertex. */
espalier_query_status espalier_for_each_crossing(const espalier_blob* blob, const espalier_ray* ray,
                                                 espalier_hit_visitor visit, void* user);

/* Write what the query of each ray returns. Both arrays have `count` elements. */
espalier_filled espalier_raycast_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_ray_hit* hits,
                                       size_t count);
espalier_filled espalier_occluded_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_yes_no* answers,
                                        size_t count);

#ifdef __cplusplus
}
#endif

#endif
