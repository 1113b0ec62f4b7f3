/* Batches of lookups by triangle id: the source triangles, materials, corners and edges of an array of triangles, such
 * as those in a batch of hits. arrays.h states what every batch refuses. Counterpart of batches/lookups.hpp. */
#ifndef ESPALIER_C_BATCHES_LOOKUPS_H
#define ESPALIER_C_BATCHES_LOOKUPS_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/advanced/lattice.h>
#include <espalier/c/batches/arrays.h>
#include <espalier/c/blob.h>
#include <espalier/c/contact.h>
#include <espalier/c/original.h>
#include <espalier/c/status.h>
#include <espalier/c/walk.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Write what espalier_original_triangle_of(), espalier_material() or espalier_triangle_at() returns for each
 * triangle. */
espalier_filled espalier_original_triangle_of_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                                     espalier_original_triangle_result* originals, size_t count);
espalier_filled espalier_material_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                         uint16_t* materials, size_t count);
espalier_filled espalier_triangle_at_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                            espalier_triangle_result* corners, size_t count);

/* What a physics engine needs of a triangle. */
typedef struct ESPALIER_SHARED_ espalier_triangle_data {
    espalier_triangle corners;
    espalier_lattice_point in_steps[3];
    uint16_t material;
    espalier_edge_kinds edges;
    uint8_t reserved[3];
} espalier_triangle_data;

typedef struct ESPALIER_SHARED_ espalier_triangle_data_result {
    espalier_triangle_data value;
    espalier_query_status status;
} espalier_triangle_data_result;

/* Writes the corners, the material and the edges of each triangle. */
espalier_filled espalier_triangle_data_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                              espalier_triangle_data_result* data, size_t count);

#ifdef __cplusplus
}
#endif

#endif
