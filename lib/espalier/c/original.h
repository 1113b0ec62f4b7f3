/* Maps a triangle or a hit back to its source: the file, mesh and triangle that were baked. Counterpart of
 * original.hpp. */
#ifndef ESPALIER_C_ORIGINAL_H
#define ESPALIER_C_ORIGINAL_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ESPALIER_SHARED_ espalier_original_triangle_result {
    espalier_original_triangle value;
    espalier_query_status status;
} espalier_original_triangle_result;

/* Returns the source of a triangle. */
espalier_original_triangle_result espalier_original_triangle_of(const espalier_blob* blob,
                                                                espalier_triangle_id triangle);
/* Writes the source of each triangle. Both arrays have `count` elements. */
espalier_filled espalier_original_triangle_of_batch(const espalier_blob* blob, const espalier_triangle_id* triangles,
                                                    espalier_original_triangle_result* originals, size_t count);

/* The triangle of the source that was hit and the weights of its corners, if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_original_hit {
    uint32_t file, mesh, triangle;
    float u, v;
    espalier_query_status status;
} espalier_original_hit;

/* Returns the source of a hit that a query on `blob` returned. */
espalier_original_hit espalier_original_hit_of(const espalier_blob* blob, const espalier_ray_hit* hit);
/* Writes the source of each hit. Both arrays have `count` elements. */
espalier_filled espalier_original_hit_of_batch(const espalier_blob* blob, const espalier_ray_hit* hits,
                                               espalier_original_hit* originals, size_t count);
/* Returns the source of a hit from the remap table of the blob's bake, which has `triangles` entries. */
espalier_original_hit espalier_original_hit_by_remap(const espalier_original_triangle* remap, size_t triangles,
                                                     const espalier_ray_hit* hit);
/* Writes the triangles of a remap file to `remap`, which has one element for each of the blob's `triangles`
 * triangles. */
espalier_open_status espalier_read_remap(const void* file, size_t size, const espalier_blob* blob,
                                         espalier_original_triangle* remap, size_t triangles);

#ifdef __cplusplus
}
#endif

#endif
