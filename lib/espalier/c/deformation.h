/* Meshes that change their vertices and keep their triangles. Counterpart of deformation.hpp.
 *
 * espalier_create_deformable() copies the part of a blob that moves to memory of yours, and espalier_deformable_refit()
 * moves the vertices there. Every query takes espalier_deformable_blob() as any other blob.
 *
 * Threads. Any number of threads may query a blob that no thread refits. */
#ifndef ESPALIER_C_DEFORMATION_H
#define ESPALIER_C_DEFORMATION_H

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

/* A view of the moving part, in memory that the caller owns, and of the rest, in the blob that it was created from.
 * Copied freely, owning nothing; both must outlive it. Filled with zeros it is not open, and calls refuse it. Its
 * content may change. */
typedef struct ESPALIER_BLOB_ espalier_deformable {
    unsigned char opaque_[sizeof(void*) == 8 ? 224 : 176];
} espalier_deformable;

/* The outcome of a refit: the vertices moved if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_refit_result {
    espalier_query_status status;
    /* The index of the first position that is refused, or the number of positions that a wrong number begins to differ
     * at; else 0. */
    uint32_t position;
    /* The cost of the tree in this pose over that at rest. From 1.5 on, bake once with this pose among the poses. If
     * the number stays, the pose itself is crowded. */
    float quality;
} espalier_refit_result;

/* Returns how many bytes espalier_create_deformable() needs: 0 if the blob is not open or not deformable. */
size_t espalier_deformable_bytes(const espalier_blob* blob);
/* Copies the moving part of a blob to `memory`, at any alignment, in the pose that the blob has, writes a view of it to
 * `mesh` and returns its status, which the view holds as well. The rest is read from the blob's bytes, which may stay
 * in flash. `memory` may be the front of the blob's own bytes, which then change.
 *
 * Refuses a blob that is not open (ESPALIER_QUERY_NOT_OPEN) or not deformable (ESPALIER_QUERY_NO_DATA), and memory of
 * fewer than espalier_deformable_bytes() (ESPALIER_QUERY_NO_ROOM) or memory that overlaps the rest
 * (ESPALIER_QUERY_INVALID_ARGUMENT). `mesh` need not be initialised. At an address that
 * is no multiple of 16 it is refused with ESPALIER_QUERY_INVALID_ARGUMENT, and then nothing is written; no other
 * function may be given such an address. */
espalier_query_status espalier_create_deformable(const espalier_blob* blob, void* memory, size_t size,
                                                 espalier_deformable* mesh);

/* Returns ESPALIER_QUERY_OK, or why every call refuses the mesh. */
espalier_query_status espalier_deformable_status(const espalier_deformable* mesh);
/* Returns the blob for queries, which is part of `mesh`. A copy of it stays valid, and always has the latest pose. */
const espalier_blob* espalier_deformable_blob(const espalier_deformable* mesh);
/* Returns how many positions a refit takes: those of all baked meshes in a row, unused ones included. */
uint32_t espalier_deformable_position_count(const espalier_deformable* mesh);
/* Returns the box that positions must lie in, from the bake; each coordinate is rounded to float. */
espalier_box espalier_deformable_range(const espalier_deformable* mesh);

/* Moves the vertices to `positions`, in the order of the baked meshes, in the blob's units. Refuses another number of
 * positions than espalier_deformable_position_count(), and a position that is NaN or infinite
 * (ESPALIER_QUERY_INVALID_ARGUMENT) or outside of the range (ESPALIER_QUERY_OUT_OF_RANGE). A refusal names the position
 * and changes nothing. */
espalier_refit_result espalier_deformable_refit(espalier_deformable* mesh, const espalier_vec3* positions,
                                                size_t count);

/* Writes the mesh in its pose as a whole blob with a new checksum, which espalier_open() takes. `size` is
 * espalier_blob_size(), else the call is refused (ESPALIER_QUERY_NO_ROOM). `bytes` may be those of the blob, with the
 * memory of the mesh at their front. With a part of the mesh at another place in them, the call is refused
 * (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_query_status espalier_deformable_seal(const espalier_deformable* mesh, void* bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
