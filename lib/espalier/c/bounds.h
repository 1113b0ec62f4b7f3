/* Bounds of the whole asset that are tighter than espalier_blob_bounds(). The blob must have been baked with them.
 * Counterpart of bounds.hpp. */
#ifndef ESPALIER_C_BOUNDS_H
#define ESPALIER_C_BOUNDS_H

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ESPALIER_K_DOP_COUNT 13

/* Slabs along 13 fixed directions: lo[k] <= dot(espalier_k_dop_directions[k], corner) <= hi[k]. */
typedef struct ESPALIER_SHARED_ espalier_k_dop {
    float lo[ESPALIER_K_DOP_COUNT];
    float hi[ESPALIER_K_DOP_COUNT];
} espalier_k_dop;

extern const espalier_vec3 espalier_k_dop_directions[ESPALIER_K_DOP_COUNT];

typedef struct ESPALIER_SHARED_ espalier_sphere_result {
    espalier_sphere value;
    espalier_query_status status;
} espalier_sphere_result;

typedef struct ESPALIER_SHARED_ espalier_oriented_box_result {
    espalier_oriented_box value;
    espalier_query_status status;
} espalier_oriented_box_result;

typedef struct ESPALIER_SHARED_ espalier_k_dop_result {
    espalier_k_dop value;
    espalier_query_status status;
} espalier_k_dop_result;

/* Returns a sphere that contains all triangles and is close to the smallest one. */
espalier_sphere_result espalier_bounding_sphere(const espalier_blob* blob);
/* Returns a box of small surface and any orientation that contains all triangles. */
espalier_oriented_box_result espalier_oriented_bounds(const espalier_blob* blob);
/* Returns slabs that contain all triangles. */
espalier_k_dop_result espalier_k_dop_bounds(const espalier_blob* blob);

#ifdef __cplusplus
}
#endif

#endif
