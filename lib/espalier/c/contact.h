/* Contacts of a body with the surface, and corrected normals at internal edges, which only join two triangles of it.
 * Counterpart of contact.hpp. */
#ifndef ESPALIER_C_CONTACT_H
#define ESPALIER_C_CONTACT_H

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

/* Where a body touches a triangle, in which case the distance is below 0, or is near it. */
typedef struct ESPALIER_SHARED_ espalier_contact {
    espalier_vec3 point, normal;
    float distance;
    espalier_triangle_id triangle;
    espalier_feature feature;
    espalier_side side;
    uint8_t reserved[2];
} espalier_contact;

/* Write the contacts with the triangles that are at most `margin` away, the deepest first, up to `capacity`. */
espalier_filled espalier_find_contacts_sphere(const espalier_blob* blob, const espalier_sphere* sphere, float margin,
                                              espalier_contact* contacts, size_t capacity);
espalier_filled espalier_find_contacts_capsule(const espalier_blob* blob, const espalier_capsule* capsule, float margin,
                                               espalier_contact* contacts, size_t capacity);
espalier_filled espalier_find_contacts_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box,
                                                    float margin, espalier_contact* contacts, size_t capacity);
espalier_filled espalier_find_contacts_convex_hull(const espalier_blob* blob, const espalier_convex_hull* hull,
                                                   float margin, espalier_contact* contacts, size_t capacity);

/* The largest number of contacts that espalier_reduce_contacts() keeps. */
#define ESPALIER_MAX_REDUCED_CONTACTS 4
/* Moves the contacts that support a body best to the front of the array and returns their number. */
size_t espalier_reduce_contacts(espalier_contact* contacts, size_t count);

/* A plane that holds a capsule back. */
typedef struct ESPALIER_SHARED_ espalier_contact_plane {
    espalier_vec3 normal;
    float distance;
    espalier_triangle_id triangle;
} espalier_contact_plane;

typedef struct ESPALIER_SHARED_ espalier_vec3_result {
    espalier_vec3 value;
    espalier_query_status status;
} espalier_vec3_result;

/* Writes the planes that hold back a capsule which moves by at most `margin`, the nearest first, up to `capacity`. */
espalier_filled espalier_collect_planes(const espalier_blob* blob, const espalier_capsule* capsule, float margin,
                                        espalier_contact_plane* planes, size_t capacity);
/* Returns the way nearest to `wish` that comes no nearer to any plane than `skin`. */
espalier_vec3_result espalier_solve_planes(const espalier_contact_plane* planes, size_t count, espalier_vec3 wish,
                                           float skin);

/* How the surface bends at an edge, as seen from the front of its triangles. */
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
/* Returns the normal to use for a contact on a feature of a triangle. `normal` leads from the surface to the body. On
 * an edge that is flat, or a valley on the side to which `normal` leads, it is the triangle's own normal; otherwise it
 * is `normal`. */
espalier_vec3 espalier_fix_internal_edge_normal(const espalier_blob* blob, espalier_triangle_id triangle,
                                                espalier_feature feature, espalier_vec3 normal);

#ifdef __cplusplus
}
#endif

#endif
