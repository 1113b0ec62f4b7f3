/* Queries in whole lattice steps, without floats. Counterpart of advanced/lattice.hpp. */
#ifndef ESPALIER_C_LATTICE_H
#define ESPALIER_C_LATTICE_H

#include <stddef.h>
#include <stdint.h>

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A point of a lattice, in whole steps. */
typedef struct ESPALIER_SHARED_ espalier_lattice_point {
    int32_t x, y, z;
} espalier_lattice_point;

typedef struct ESPALIER_SHARED_ espalier_lattice_box {
    espalier_lattice_point min, max;
} espalier_lattice_box;

typedef struct ESPALIER_SHARED_ espalier_lattice_segment {
    espalier_lattice_point from, to;
} espalier_lattice_segment;

/* The largest magnitude of a segment's coordinates and of those that espalier_to_lattice_point() returns. */
#define ESPALIER_MAX_LATTICE_COORDINATE (INT32_C(1) << 29)

/* The value is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_lattice_point_result {
    espalier_lattice_point value;
    espalier_query_status status;
} espalier_lattice_point_result;
typedef struct ESPALIER_SHARED_ espalier_lattice_box_result {
    espalier_lattice_box value;
    espalier_query_status status;
} espalier_lattice_box_result;

/* Returns the lattice point nearest to a point in the blob's local space. */
espalier_lattice_point_result espalier_to_lattice_point(const espalier_lattice* lattice, const espalier_vec3* local);
/* Returns the smallest box in whole steps that contains a box in local space. */
espalier_lattice_box_result espalier_to_lattice_box(const espalier_lattice* lattice, const espalier_box* local);
/* Returns the position of a lattice point in the blob's local space. */
espalier_vec3 espalier_to_local(const espalier_lattice* lattice, const espalier_lattice_point* steps);

/* Test for, visit or collect the triangles that touch the box, like the functions of overlap.h. */
espalier_yes_no espalier_overlaps_lattice_box(const espalier_blob* blob, const espalier_lattice_box* box);
espalier_query_status espalier_for_each_overlap_lattice_box(const espalier_blob* blob, const espalier_lattice_box* box,
                                                            espalier_triangle_visitor visit, void* user);
espalier_filled espalier_collect_overlaps_lattice_box(const espalier_blob* blob, const espalier_lattice_box* box,
                                                      espalier_triangle_id* out, size_t capacity, espalier_cursor from);

/* Where a segment hits a triangle, if the status is ESPALIER_QUERY_OK; otherwise t is UINT32_MAX and the triangle is
 * ESPALIER_NO_TRIANGLE. */
typedef struct ESPALIER_SHARED_ espalier_lattice_hit {
    uint32_t t;
    espalier_triangle_id triangle;
    espalier_query_status status;
    espalier_side side;
    uint8_t reserved[2];
} espalier_lattice_hit;

/* Returns the hit with the smallest t. On a tie the lowest triangle wins. */
espalier_lattice_hit espalier_raycast_lattice_segment(const espalier_blob* blob,
                                                      const espalier_lattice_segment* segment);
/* Returns whether the segment hits any triangle. */
espalier_yes_no espalier_occluded_lattice_segment(const espalier_blob* blob, const espalier_lattice_segment* segment);

#ifdef __cplusplus
}
#endif

#endif
