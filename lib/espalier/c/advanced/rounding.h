/* How far rounding moves a query, and rays that are rounded once for several blobs. Counterpart of
 * advanced/rounding.hpp. */
#ifndef ESPALIER_C_ROUNDING_H
#define ESPALIER_C_ROUNDING_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/transform.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Return an upper bound on how far rounding moves the query, in the blob's units. */
espalier_float_result espalier_rounding_error_point(const espalier_blob* blob, espalier_vec3 point);
espalier_float_result espalier_rounding_error_ray(const espalier_blob* blob, const espalier_ray* ray);
espalier_float_result espalier_rounding_error_segment(const espalier_blob* blob, const espalier_segment* segment);
espalier_float_result espalier_rounding_error_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
espalier_float_result espalier_rounding_error_capsule(const espalier_blob* blob, const espalier_capsule* capsule);
espalier_float_result espalier_rounding_error_box(const espalier_blob* blob, const espalier_box* box);
espalier_float_result espalier_rounding_error_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box);
espalier_float_result espalier_rounding_error_triangle(const espalier_blob* blob, const espalier_triangle* triangle);

/* Return an upper bound on how far rounding moves the shape of a sweep, at its start and on its way. */
espalier_float_result espalier_rounding_error_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                           espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                            espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_box(const espalier_blob* blob, const espalier_box* box,
                                                        espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_oriented_box(const espalier_blob* blob,
                                                                 const espalier_oriented_box* box,
                                                                 espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_convex_hull(const espalier_blob* blob,
                                                                const espalier_convex_hull* hull,
                                                                espalier_vec3 displacement);

/* A ray in integers on the lattice of a region. Its content may change from version to version. Any bits are safe:
 * those that are no rounded ray are refused. */
typedef struct ESPALIER_SHARED_ espalier_rounded_ray {
    uint32_t opaque_[21];
} espalier_rounded_ray;

/* The value is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_lattice_result {
    espalier_lattice value;
    espalier_query_status status;
} espalier_lattice_result;

/* Returns the region that encloses all blobs with triangles. */
espalier_lattice_result espalier_lattice_of_blobs(const espalier_blob* blobs, size_t count);
/* Rounds a ray for all blobs in the region. */
espalier_rounded_ray espalier_round_ray(const espalier_lattice* region, const espalier_ray* ray);
/* Returns ESPALIER_QUERY_OK, or why the ray was refused, which every query with it then returns as well. */
espalier_query_status espalier_rounded_ray_status(const espalier_rounded_ray* ray);
/* Returns the closest hit, like espalier_raycast(). */
espalier_ray_hit espalier_raycast_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray);
/* Returns whether the ray hits any triangle. */
espalier_yes_no espalier_occluded_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray);
/* Return the same for the triangles that the filter keeps. */
espalier_ray_hit espalier_raycast_rounded_filtered(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                                   espalier_triangle_filter filter, void* user);
espalier_yes_no espalier_occluded_rounded_filtered(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                                   espalier_triangle_filter filter, void* user);
/* Calls the visitor with each hit, like espalier_for_each_hit(). */
espalier_query_status espalier_for_each_hit_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                                    espalier_hit_visitor visit, void* user);
/* Calls the visitor with each crossing, like espalier_for_each_crossing(). */
espalier_query_status espalier_for_each_crossing_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                                         espalier_hit_visitor visit, void* user);
/* Moves a ray into the local space of a transform that translates by whole steps of its region's lattice and does
 * nothing else. */
espalier_rounded_ray espalier_to_local_rounded_ray(const espalier_transform* transform,
                                                   const espalier_rounded_ray* ray);

#ifdef __cplusplus
}
#endif

#endif
