/* Contacts on edges that only join two triangles of one surface. Counterpart of contact.hpp. */
#ifndef ESPALIER_C_CONTACT_H
#define ESPALIER_C_CONTACT_H

#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The bend of the surface at an edge, seen from the front of its triangles. */
typedef uint8_t espalier_edge_kind;
enum { ESPALIER_EDGE_FLAT = 0, ESPALIER_EDGE_CONVEX = 1, ESPALIER_EDGE_CONCAVE = 2, ESPALIER_EDGE_BOUNDARY = 3 };

/* The kinds of a triangle's edges. */
typedef struct ESPALIER_SHARED_ espalier_edge_kinds {
    espalier_edge_kind ab, bc, ca;
} espalier_edge_kinds;

typedef struct ESPALIER_SHARED_ espalier_edge_kinds_result {
    espalier_edge_kinds value;
    espalier_query_status status;
} espalier_edge_kinds_result;

/* Returns the kinds of a triangle's edges. */
espalier_edge_kinds_result espalier_edge_kinds_of(const espalier_blob* blob, espalier_triangle_id triangle);
/* Returns the normal to use for a contact on a feature of a triangle: on a flat or concave edge the triangle's own
 * normal, else `normal`, which leads from the surface to the body. */
espalier_vec3 espalier_fix_internal_edge_normal(const espalier_blob* blob, espalier_triangle_id triangle,
                                                espalier_feature feature, espalier_vec3 normal);

#ifdef __cplusplus
}
#endif

#endif
