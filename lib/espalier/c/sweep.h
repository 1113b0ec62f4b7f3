/* Sweep queries: the first contact of a shape that moves along a straight line. Counterpart of sweep.hpp. */
#ifndef ESPALIER_C_SWEEP_H
#define ESPALIER_C_SWEEP_H

#include <stdbool.h>
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

/* The first contact, if the status is ESPALIER_QUERY_OK. A miss has a t of 1 and a refusal, unlike in other results, a
 * t of 0, so moving the shape by t * displacement is always safe if the displacement is finite. */
typedef struct ESPALIER_SHARED_ espalier_sweep_hit {
    float t;
    espalier_vec3 point, normal, face_normal;
    espalier_triangle_id triangle;
    espalier_query_status status;
    espalier_feature feature;
    uint8_t reserved;
    bool starts_overlapping;
} espalier_sweep_hit;

/* Return the first contact of the shape as it moves from where it is by `displacement`. */
espalier_sweep_hit espalier_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                         espalier_vec3 displacement);
espalier_sweep_hit espalier_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                          espalier_vec3 displacement);
espalier_sweep_hit espalier_sweep_box(const espalier_blob* blob, const espalier_box* box, espalier_vec3 displacement);
espalier_sweep_hit espalier_sweep_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box,
                                               espalier_vec3 displacement);
espalier_sweep_hit espalier_sweep_convex_hull(const espalier_blob* blob, const espalier_convex_hull* hull,
                                              espalier_vec3 displacement);

/* Selects the triangles that a sweep considers, and where the shape stops. If all members are zero, it considers all
 * triangles, without a skin. */
typedef struct ESPALIER_SHARED_ espalier_sweep_options {
    espalier_triangle_filter filter; /* null keeps all triangles */
    void* user;                      /* passed to `filter` */
    float skin;
    espalier_face_culling culling;
    bool ignore_leaving;
    uint8_t reserved[2];
} espalier_sweep_options;

/* Return the first contact with the given options. */
espalier_sweep_hit espalier_sweep_sphere_with_options(const espalier_blob* blob, const espalier_sphere* sphere,
                                                      espalier_vec3 displacement,
                                                      const espalier_sweep_options* options);
espalier_sweep_hit espalier_sweep_capsule_with_options(const espalier_blob* blob, const espalier_capsule* capsule,
                                                       espalier_vec3 displacement,
                                                       const espalier_sweep_options* options);
espalier_sweep_hit espalier_sweep_box_with_options(const espalier_blob* blob, const espalier_box* box,
                                                   espalier_vec3 displacement, const espalier_sweep_options* options);
espalier_sweep_hit espalier_sweep_oriented_box_with_options(const espalier_blob* blob, const espalier_oriented_box* box,
                                                            espalier_vec3 displacement,
                                                            const espalier_sweep_options* options);
espalier_sweep_hit espalier_sweep_convex_hull_with_options(const espalier_blob* blob, const espalier_convex_hull* hull,
                                                           espalier_vec3 displacement,
                                                           const espalier_sweep_options* options);

/* Return the first contact with a triangle that the filter keeps. */
espalier_sweep_hit espalier_sweep_sphere_filtered(const espalier_blob* blob, const espalier_sphere* sphere,
                                                  espalier_vec3 displacement, espalier_triangle_filter filter,
                                                  void* user);
espalier_sweep_hit espalier_sweep_capsule_filtered(const espalier_blob* blob, const espalier_capsule* capsule,
                                                   espalier_vec3 displacement, espalier_triangle_filter filter,
                                                   void* user);
espalier_sweep_hit espalier_sweep_box_filtered(const espalier_blob* blob, const espalier_box* box,
                                               espalier_vec3 displacement, espalier_triangle_filter filter, void* user);
espalier_sweep_hit espalier_sweep_oriented_box_filtered(const espalier_blob* blob, const espalier_oriented_box* box,
                                                        espalier_vec3 displacement, espalier_triangle_filter filter,
                                                        void* user);
espalier_sweep_hit espalier_sweep_convex_hull_filtered(const espalier_blob* blob, const espalier_convex_hull* hull,
                                                       espalier_vec3 displacement, espalier_triangle_filter filter,
                                                       void* user);

#ifdef __cplusplus
}
#endif

#endif
