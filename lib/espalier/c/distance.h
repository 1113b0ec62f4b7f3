/* Distance queries: the closest point of the surface, the closest triangles, and whether a point is inside. Counterpart
 * of distance.hpp. */
#ifndef ESPALIER_C_DISTANCE_H
#define ESPALIER_C_DISTANCE_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ClosestPoint of C++. The status is ESPALIER_QUERY_OK if there is a closest point. */
typedef struct ESPALIER_SHARED_ espalier_closest_point_result {
    espalier_vec3 point, on_shape, face_normal;
    float distance, u, v;
    espalier_triangle_id triangle;
    espalier_query_status status;
    espalier_feature feature;
    espalier_side side;
    uint8_t reserved;
} espalier_closest_point_result;

/* Returns the closest point of the surface within max_distance, which may be INFINITY. */
espalier_closest_point_result espalier_closest_point(const espalier_blob* blob, espalier_vec3 point,
                                                     float max_distance);
/* Return the closest pair of points, one on the shape and one on the surface. */
espalier_closest_point_result espalier_closest_point_segment(const espalier_blob* blob, const espalier_segment* segment,
                                                             float max_distance);
espalier_closest_point_result espalier_closest_point_box(const espalier_blob* blob, const espalier_box* box,
                                                         float max_distance);
/* Writes the triangles closest to the point, sorted by distance, up to `capacity`. */
espalier_filled espalier_closest_triangles(const espalier_blob* blob, espalier_vec3 point,
                                           espalier_closest_point_result* nearest, size_t capacity, float max_distance);

/* Returns whether the point is inside the closed surface. */
espalier_yes_no espalier_contains(const espalier_blob* blob, espalier_vec3 point);
/* Returns the closest point of the closed surface, with a negative distance if the point is inside. */
espalier_closest_point_result espalier_signed_distance(const espalier_blob* blob, espalier_vec3 point,
                                                       float max_distance);

/* Returns approximately how often the surface, which may be open, winds around the point; above 0.5 is inside.
 * `directions` is 2 to 4096, usually 64. */
espalier_float_result espalier_winding_number(const espalier_blob* blob, espalier_vec3 point, uint32_t directions);

#ifdef __cplusplus
}
#endif

#endif
