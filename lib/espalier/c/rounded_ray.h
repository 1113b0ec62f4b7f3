/* Rays against several blobs on one lattice, such as the tiles of a terrain. Counterpart of rounded_ray.hpp. */
#ifndef ESPALIER_C_ROUNDED_RAY_H
#define ESPALIER_C_ROUNDED_RAY_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A ray in whole numbers on the lattice of a region. Its content may change. Any bits are safe: those that are no
 * rounded ray are refused. */
typedef struct ESPALIER_SHARED_ espalier_rounded_ray {
    uint32_t opaque_[21];
} espalier_rounded_ray;

/* The value counts only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_lattice_result {
    espalier_lattice value;
    espalier_query_status status;
} espalier_lattice_result;

/* Returns the region around all blobs that have triangles. */
espalier_lattice_result espalier_lattice_of_blobs(const espalier_blob* blobs, size_t count);
/* Returns the ray rounded for all blobs within the region. */
espalier_rounded_ray espalier_round_ray(const espalier_lattice* region, const espalier_ray* ray);
/* Returns ESPALIER_QUERY_OK, or why the ray was refused: every query of it returns that again. */
espalier_query_status espalier_rounded_ray_status(const espalier_rounded_ray* ray);
/* Returns the closest hit, as espalier_raycast() does. */
espalier_ray_hit espalier_raycast_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray);
/* Returns whether the ray hits any triangle. */
espalier_yes_no espalier_occluded_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray);

#ifdef __cplusplus
}
#endif

#endif
