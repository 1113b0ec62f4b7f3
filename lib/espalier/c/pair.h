/* Queries of two placed blobs: whether their surfaces touch, where, and how far apart they are. Counterpart of
 * pair.hpp.
 *
 * `work_limit` is the number of pairs of nodes or leaves that a query may visit. */
#ifndef ESPALIER_C_PAIR_H
#define ESPALIER_C_PAIR_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/status.h>
#include <espalier/c/transform.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* As `work_limit`: the query may visit all. */
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

/* Returns whether a triangle of a touches one of b. At the work limit it is neither yes nor no. */
espalier_yes_no espalier_overlaps_blob(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                       uint64_t work_limit);
/* Returns a pair of triangles that touch. */
espalier_pair_contact espalier_first_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                             uint64_t work_limit);

typedef espalier_visit (*espalier_pair_visitor)(const espalier_pair_contact* contact, void* user);
/* Visits each pair of triangles that touch, until the visitor stops. */
espalier_query_status espalier_for_each_contact(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                                espalier_pair_visitor visit, void* user, uint64_t work_limit);
/* Writes these pairs in pages of at most `capacity`, from a cursor of zeros or from `next` of the page before. After
 * ESPALIER_QUERY_WORK_LIMIT, pairs are missing: `next` resumes, or equals `from` if the limit is too small. */
espalier_filled espalier_collect_contacts(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                          espalier_pair_contact* contacts, size_t capacity, uint64_t work_limit,
                                          espalier_cursor from);

/* Returns the smallest distance of the two surfaces within max_distance, and where it is. */
espalier_blob_distance espalier_distance(const espalier_placed_blob* a, const espalier_placed_blob* b,
                                         uint64_t work_limit, float max_distance);
/* Returns whether the surfaces are within `distance` of each other; equal counts. */
espalier_yes_no espalier_within_distance(const espalier_placed_blob* a, const espalier_placed_blob* b, float distance,
                                         uint64_t work_limit);

#ifdef __cplusplus
}
#endif

#endif
