/* Opening a blob, and its properties. Counterpart of blob.hpp. */
#ifndef ESPALIER_C_BLOB_H
#define ESPALIER_C_BLOB_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A view of a baked mesh, which can be copied freely and owns nothing. The bytes must outlive it and must not change,
 * except by a refit (deformation.h). A view filled with zeros was never opened: it has no triangles, and queries refuse
 * it. Its content may change from version to version. */
typedef struct ESPALIER_BLOB_ espalier_blob {
    unsigned char opaque_[sizeof(void*) == 8 ? 192 : 160];
} espalier_blob;

/* Proves that every query on the bytes is safe, writes a view of them to `blob`, and returns its status, which the blob
 * stores as well. Takes any bytes at any alignment; `bytes` may be null if `size` is 0. `blob` need not be initialised.
 * If its address is not a multiple of 16, the call is refused with ESPALIER_OPEN_MISALIGNED and writes nothing; do not
 * pass such an address to any other function. */
espalier_open_status espalier_open(const void* bytes, size_t size, espalier_blob* blob);
/* Opens bytes that are linked into your own program, in O(1), by checking only the header. If the bytes are not exactly
 * what the baker wrote, queries may read any address. */
espalier_open_status espalier_open_unchecked(const void* bytes, size_t size, espalier_blob* blob);

/* The lattice of a blob. A coordinate in the blob's units is origin + steps * 2^step_exponent. */
typedef struct ESPALIER_SHARED_ espalier_lattice {
    espalier_vec3 origin;
    int32_t step_exponent;
    int32_t extent[3];
} espalier_lattice;

/* The encoding of the nodes and leaves of a blob. */
typedef uint8_t espalier_profile;
enum {
    ESPALIER_PROFILE_FAST = 0,
    ESPALIER_PROFILE_BALANCED = 1,
    ESPALIER_PROFILE_SMALL = 2,
    ESPALIER_PROFILE_TINY = 3
};

/* Returns ESPALIER_OPEN_OK, or why the blob is not open. */
espalier_open_status espalier_blob_status(const espalier_blob* blob);
/* Returns the number of triangles, including duplicate references. Every triangle id is lower. */
uint32_t espalier_blob_triangle_count(const espalier_blob* blob);
/* Returns how many triangles are duplicate references to another triangle. Above 0 only with spatial splits. */
uint32_t espalier_blob_duplicate_reference_count(const espalier_blob* blob);
uint32_t espalier_blob_vertex_count(const espalier_blob* blob);
/* Returns the size in bytes. */
uint32_t espalier_blob_size(const espalier_blob* blob);
/* Returns the checksum in the header. A refit does not update it. */
uint32_t espalier_blob_checksum(const espalier_blob* blob);
/* Returns the number of nodes on the longest path from the root. */
unsigned espalier_blob_depth(const espalier_blob* blob);
espalier_profile espalier_blob_profile(const espalier_blob* blob);
/* Returns the lattice on which the corners lie. */
espalier_lattice espalier_blob_lattice(const espalier_blob* blob);
/* Returns an upper bound on the distance between the baked surface and its source, in the blob's units. */
float espalier_blob_max_error(const espalier_blob* blob);
/* Returns the point of the source that is the origin of the blob: what the baker subtracted from all positions. */
espalier_vec3d espalier_blob_source_origin(const espalier_blob* blob);
/* Returns the box around all triangles. */
espalier_box espalier_blob_bounds(const espalier_blob* blob);
/* Returns whether the surface has an inside, as espalier_contains() and espalier_signed_distance() require. */
bool espalier_blob_is_closed(const espalier_blob* blob);
/* Returns whether the vertices can move (deformation.h). */
bool espalier_blob_is_deformable(const espalier_blob* blob);
/* Return whether the blob stores what original.h, espalier_material() and contact.h read, respectively. */
bool espalier_blob_has_original_ids(const espalier_blob* blob);
bool espalier_blob_has_materials(const espalier_blob* blob);
bool espalier_blob_has_edge_flags(const espalier_blob* blob);

/* Returns the material number that was given to the baker, or 0 if the blob stores none or has no such triangle. */
uint16_t espalier_material(const espalier_blob* blob, espalier_triangle_id triangle);

#ifdef __cplusplus
}
#endif

#endif
