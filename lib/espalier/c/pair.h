/* Queries on two placed blobs: whether their surfaces touch, where and how deep, and how far apart they are.
 * Counterpart of pair.hpp.
 *
 * `work_limit` is the number of pairs of nodes or leaves that a query may visit. */
#ifndef ESPALIER_C_PAIR_H
#define ESPALIER_C_PAIR_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/contact.h>
#include <espalier/c/status.h>
#include <espalier/c/transform.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A `work_limit` that lets the query visit all pairs. */
#define ESPALIER_WORK_UNLIMITED UINT64_MAX

/* Two triangles that touch, one of each blob, if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_pair_contact {
    espalier_triangle_id a, b;
    espalier_query_status status;
} espalier_pair_contact;

/* The nearest points of two surfaces, if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_blob_distance {
    float distance;
    espalier_vec3 on_a, on_b;
    espalier_triangle_id a, b;
    espalier_query_status status;
} espalier_blob_distance;

/* Returns whether a triangle of a touches one of b. If the work limit is reached, the answer is neither yes nor no. */
espalier_yes_no espalier_overlaps_blob(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                       uint64_t work_limit);
/* Returns a pair of triangles that touch. */
espalier_pair_contact espalier_first_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                             uint64_t work_limit);

typedef espalier_visit (*espalier_pair_visitor)(const espalier_pair_contact* contact, void* user);
/* Visits each pair of triangles that touch, until the visitor stops. */
espalier_query_status espalier_for_each_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                espalier_pair_visitor visit, void* user, uint64_t work_limit);
/* Writes these pairs in pages of at most `capacity`. `from` is a cursor of zeros for the first page, then the `next` of
 * the previous page. After ESPALIER_QUERY_WORK_LIMIT, pairs are missing: `next` resumes, or equals `from` if the limit
 * is too small. */
espalier_filled espalier_collect_contacts(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                          espalier_pair_contact* contacts, size_t capacity, uint64_t work_limit,
                                          espalier_cursor from);

/* The largest number of points of an espalier_pair_touch. */
#define ESPALIER_MAX_TOUCH_POINTS 6

/* The contact between two triangles, one of each blob, if the status is ESPALIER_QUERY_OK. The hull of the points is
 * what the triangles have in common. Moving b along the normal, which leads from a to b, by the depth separates
 * them. */
typedef struct ESPALIER_SHARED_ espalier_pair_touch {
    espalier_vec3 points[ESPALIER_MAX_TOUCH_POINTS];
    espalier_vec3 normal;
    float depth;
    espalier_triangle_id a, b;
    uint8_t count;
    espalier_query_status status;
    uint8_t reserved[2];
} espalier_pair_touch;

/* Returns the contact between the triangles of a pair that espalier_collect_contacts() found for the same
 * placements. */
espalier_pair_touch espalier_pair_touch_of(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                           const espalier_pair_contact* pair);

typedef espalier_visit (*espalier_touch_visitor)(const espalier_pair_touch* touch, void* user);
/* Visits the contact of each touching pair, until the visitor stops. */
espalier_query_status espalier_for_each_touch(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                              espalier_touch_visitor visit, void* user, uint64_t work_limit);
/* Writes these contacts in pages of at most `capacity`, as espalier_collect_contacts() writes pairs. */
espalier_filled espalier_collect_touches(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                         espalier_pair_touch* touches, size_t capacity, uint64_t work_limit,
                                         espalier_cursor from);

/* Returns one of the points as a contact of body b with the surface a, for espalier_reduce_contacts(). */
espalier_contact espalier_contact_of_touch(const espalier_pair_touch* touch, size_t number);

/* Returns the smallest distance between the two surfaces, if it is within max_distance, and where it is. */
espalier_blob_distance espalier_distance(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                         uint64_t work_limit, float max_distance);
/* Returns whether the surfaces are at most `distance` apart. */
espalier_yes_no espalier_within_distance(const espalier_placed_blob* a, const espalier_placed_blob* b, float distance,
                                         uint64_t work_limit);

#ifdef __cplusplus
}
#endif

#endif
