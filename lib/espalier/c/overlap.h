/* Overlap queries: which triangles touch a shape. advanced/lattice.h has those of a box in lattice steps. Counterpart
 * of overlap.hpp. */
#ifndef ESPALIER_C_OVERLAP_H
#define ESPALIER_C_OVERLAP_H

#include <stddef.h>

#include <espalier/c/blob.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>
#include <espalier/c/visitor.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Return whether any triangle touches the shape. */
espalier_yes_no espalier_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
espalier_yes_no espalier_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule);
espalier_yes_no espalier_overlaps_box(const espalier_blob* blob, const espalier_box* box);
espalier_yes_no espalier_overlaps_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box);
espalier_yes_no espalier_overlaps_cone(const espalier_blob* blob, const espalier_cone* cone);
espalier_yes_no espalier_overlaps_triangle(const espalier_blob* blob, const espalier_triangle* triangle);
espalier_yes_no espalier_overlaps_convex_volume(const espalier_blob* blob, const espalier_convex_volume* volume);

/* Visit each triangle that touches the shape once, until the visitor stops. */
espalier_query_status espalier_for_each_overlap_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                       espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                        espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_box(const espalier_blob* blob, const espalier_box* box,
                                                    espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_oriented_box(const espalier_blob* blob,
                                                             const espalier_oriented_box* box,
                                                             espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_cone(const espalier_blob* blob, const espalier_cone* cone,
                                                     espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_triangle(const espalier_blob* blob, const espalier_triangle* triangle,
                                                         espalier_triangle_visitor visit, void* user);
espalier_query_status espalier_for_each_overlap_convex_volume(const espalier_blob* blob,
                                                              const espalier_convex_volume* volume,
                                                              espalier_triangle_visitor visit, void* user);

/* Write each triangle that touches the shape once, in pages of at most `capacity`. `from` is filled with zeros for the
 * first page, then the `next` of the previous page. */
espalier_filled espalier_collect_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                 espalier_triangle_id* out, size_t capacity, espalier_cursor from);
espalier_filled espalier_collect_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                  espalier_triangle_id* out, size_t capacity, espalier_cursor from);
espalier_filled espalier_collect_overlaps_box(const espalier_blob* blob, const espalier_box* box,
                                              espalier_triangle_id* out, size_t capacity, espalier_cursor from);
espalier_filled espalier_collect_overlaps_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box,
                                                       espalier_triangle_id* out, size_t capacity,
                                                       espalier_cursor from);
espalier_filled espalier_collect_overlaps_cone(const espalier_blob* blob, const espalier_cone* cone,
                                               espalier_triangle_id* out, size_t capacity, espalier_cursor from);
espalier_filled espalier_collect_overlaps_triangle(const espalier_blob* blob, const espalier_triangle* triangle,
                                                   espalier_triangle_id* out, size_t capacity, espalier_cursor from);
espalier_filled espalier_collect_overlaps_convex_volume(const espalier_blob* blob, const espalier_convex_volume* volume,
                                                        espalier_triangle_id* out, size_t capacity,
                                                        espalier_cursor from);

#ifdef __cplusplus
}
#endif

#endif
