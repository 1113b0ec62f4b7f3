/* Batches of points, spheres and boxes in arrays: closest points and triangles, points inside, and overlaps. arrays.h
 * states what every batch refuses. Counterpart of batches/shapes.hpp. */
#ifndef ESPALIER_C_BATCHES_SHAPES_H
#define ESPALIER_C_BATCHES_SHAPES_H

#include <stddef.h>

#include <espalier/c/attributes.h>
#include <espalier/c/batches/arrays.h>
#include <espalier/c/blob.h>
#include <espalier/c/distance.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The fields of espalier_sphere, each in an array of its own. */
typedef struct ESPALIER_SHARED_ espalier_sphere_arrays {
    espalier_strided_vec3 centers;
    espalier_strided_float radii;
} espalier_sphere_arrays;

/* The fields of espalier_box, each in an array of its own. */
typedef struct ESPALIER_SHARED_ espalier_box_arrays {
    espalier_strided_vec3 min, max;
} espalier_box_arrays;

/* Write what espalier_closest_point(), espalier_signed_distance() or espalier_contains() returns for each point. */
espalier_filled espalier_closest_point_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                              espalier_closest_point_result* nearest, size_t count, float max_distance);
espalier_filled espalier_signed_distance_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                                espalier_closest_point_result* nearest, size_t count,
                                                float max_distance);
espalier_filled espalier_contains_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                         espalier_yes_no* answers, size_t count);

/* Writes what espalier_closest_triangles() returns for each point to `found`, and the triangles to `nearest`, which has
 * count * places elements. Those of point i begin at i * places. */
espalier_filled espalier_closest_triangles_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                                  espalier_closest_point_result* nearest, size_t places,
                                                  espalier_filled* found, size_t count, float max_distance);

/* Write what espalier_overlaps_sphere() or espalier_overlaps_box() returns for each shape. */
espalier_filled espalier_overlaps_sphere_arrays(const espalier_blob* blob, const espalier_sphere_arrays* spheres,
                                                espalier_yes_no* answers, size_t count);
espalier_filled espalier_overlaps_box_arrays(const espalier_blob* blob, const espalier_box_arrays* boxes,
                                             espalier_yes_no* answers, size_t count);

/* Write the triangles that touch each shape, in the order of espalier_for_each_overlap_sphere() or
 * espalier_for_each_overlap_box(), and the status that it returns to `statuses`. `triangles` has `capacity`
 * elements. */
espalier_filled_lists espalier_collect_overlaps_sphere_arrays(const espalier_blob* blob,
                                                              const espalier_sphere_arrays* spheres,
                                                              espalier_query_status* statuses, size_t* offsets,
                                                              size_t count, espalier_triangle_id* triangles,
                                                              size_t capacity);
espalier_filled_lists espalier_collect_overlaps_box_arrays(const espalier_blob* blob, const espalier_box_arrays* boxes,
                                                           espalier_query_status* statuses, size_t* offsets,
                                                           size_t count, espalier_triangle_id* triangles,
                                                           size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
