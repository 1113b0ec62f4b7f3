/* Meshes whose vertices move while their triangles stay. Counterpart of deformation.hpp.
 *
 * espalier_create_deformable() copies the part of a blob that moves to memory of yours, where
 * espalier_deformable_refit() moves the vertices. Every query takes espalier_deformable_blob() like any other blob.
 *
 * Threads. Any number of threads may query a blob while no thread refits it. */
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

/* A view of a deformable mesh: its moving part is in memory that the caller owns, the rest in the blob that it was
 * created from. It can be copied freely and owns nothing; both must outlive it. Filled with zeros, it is not open, and
 * calls refuse it. Its content may change from version to version. */
typedef struct ESPALIER_BLOB_ espalier_deformable {
    unsigned char opaque_[sizeof(void*) == 8 ? 224 : 176];
} espalier_deformable;

/* The outcome of a refit: the vertices moved if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_refit_result {
    espalier_query_status status;
    /* The index of the first position that was refused; if the number of positions is wrong, the smaller of the two
     * numbers; otherwise 0. */
    uint32_t position;
    /* The cost of the tree in this pose relative to that at rest. If it reaches 1.5, bake once more with this pose
     * among the poses. If that does not lower it, the pose itself is crowded. */
    float quality;
} espalier_refit_result;

/* Returns how many bytes espalier_create_deformable() needs, or 0 if the blob is not open or not deformable. */
size_t espalier_deformable_bytes(const espalier_blob* blob);
/* Copies the moving part of a blob, in its current pose, to `memory`, which may have any alignment; writes a view of it
 * to `mesh`; and returns its status, which the view stores as well. The rest is read from the blob's bytes, which may
 * stay in flash. `memory` may be the front of the blob's own bytes, which then change.
 *
 * Refuses a blob that is not open (ESPALIER_QUERY_NOT_OPEN) or not deformable (ESPALIER_QUERY_NO_DATA), memory of fewer
 * than espalier_deformable_bytes() bytes (ESPALIER_QUERY_NO_ROOM), and memory that overlaps the rest
 * (ESPALIER_QUERY_INVALID_ARGUMENT). `mesh` need not be initialised. If its address is not a multiple of 16, the call
 * is refused with ESPALIER_QUERY_INVALID_ARGUMENT and writes nothing; do not pass such an address to any other
 * function. */
espalier_query_status espalier_create_deformable(const espalier_blob* blob, void* memory, size_t size,
                                                 espalier_deformable* mesh);

/* Returns ESPALIER_QUERY_OK, or why every call refuses the mesh. */
espalier_query_status espalier_deformable_status(const espalier_deformable* mesh);
/* Returns the blob to query, which is part of `mesh`. A copy of it stays valid and always has the latest pose. */
const espalier_blob* espalier_deformable_blob(const espalier_deformable* mesh);
/* Returns the number of positions that a refit takes: those of all baked meshes one after the other, including unused
 * ones. */
uint32_t espalier_deformable_position_count(const espalier_deformable* mesh);
/* Returns the box in which positions must lie, fixed by the bake, with each coordinate rounded to float. */
espalier_box espalier_deformable_range(const espalier_deformable* mesh);

/* Moves the vertices to `positions`, in the blob's units and in the order of the baked meshes. Refuses any number of
 * positions but espalier_deformable_position_count(), a position that is NaN or infinite
 * (ESPALIER_QUERY_INVALID_ARGUMENT), and one outside the range (ESPALIER_QUERY_OUT_OF_RANGE). A refusal names the
 * position and changes nothing. */
espalier_refit_result espalier_deformable_refit(espalier_deformable* mesh, const espalier_vec3* positions,
                                                size_t count);

/* Writes the mesh in its current pose as a complete blob with a new checksum, which espalier_open() accepts. `size`
 * must be espalier_blob_size() (otherwise: ESPALIER_QUERY_NO_ROOM). `bytes` may be those of the blob itself, with the
 * memory of the mesh at their front; if a part of the mesh lies at a different place in them, the call is refused
 * (ESPALIER_QUERY_INVALID_ARGUMENT). */
espalier_query_status espalier_deformable_seal(const espalier_deformable* mesh, void* bytes, size_t size);

#ifdef __cplusplus
}
#endif

#endif
