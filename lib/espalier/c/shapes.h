/* The shapes that queries take. Counterpart of shapes.hpp. */
#ifndef ESPALIER_C_SHAPES_H
#define ESPALIER_C_SHAPES_H

#include <stddef.h>

#include <espalier/c/attributes.h>
#include <espalier/c/types.h>

typedef struct ESPALIER_SHARED_ espalier_segment {
    espalier_vec3 from, to;
} espalier_segment;

typedef struct ESPALIER_SHARED_ espalier_sphere {
    espalier_vec3 center;
    float radius;
} espalier_sphere;

/* All points within `radius` of the segment between `from` and `to`. */
typedef struct ESPALIER_SHARED_ espalier_capsule {
    espalier_vec3 from, to;
    float radius;
} espalier_capsule;

/* An axis-aligned box. It is empty if a coordinate of `min` exceeds that of `max`. */
typedef struct ESPALIER_SHARED_ espalier_box {
    espalier_vec3 min, max;
} espalier_box;

/* A box of any orientation. Each half axis leads from the center to the middle of a face. */
typedef struct ESPALIER_SHARED_ espalier_oriented_box {
    espalier_vec3 center;
    espalier_vec3 half_axes[3];
} espalier_oriented_box;

/* The convex hull of `apex` and a disc that is centered at apex + axis, perpendicular to the axis, and has this
 * radius. */
typedef struct ESPALIER_SHARED_ espalier_cone {
    espalier_vec3 apex, axis;
    float radius;
} espalier_cone;

/* The half-space dot(normal, x) <= offset. The normal may have any length but zero. */
typedef struct ESPALIER_SHARED_ espalier_plane {
    espalier_vec3 normal;
    float offset;
} espalier_plane;

/* The largest number of planes of an espalier_convex_volume. */
#define ESPALIER_MAX_PLANES 32

/* All points behind every one of the planes, of which there are at most ESPALIER_MAX_PLANES. The planes must outlive
 * it. */
typedef struct ESPALIER_SHARED_ espalier_convex_volume {
    const espalier_plane* planes;
    size_t plane_count;
} espalier_convex_volume;

/* The largest number of vertices of an espalier_convex_hull. */
#define ESPALIER_MAX_HULL_VERTICES 64

/* The convex hull of at most ESPALIER_MAX_HULL_VERTICES vertices, in any order; without vertices it is empty. The
 * vertices must outlive it. */
typedef struct ESPALIER_SHARED_ espalier_convex_hull {
    const espalier_vec3* vertices;
    size_t vertex_count;
} espalier_convex_hull;

/* Applies a macro to the C and C++ names of each shape that both languages lay out alike and that
 * espalier_overlaps_<name>() takes. Internal to the library. */
#define ESPALIER_SHAPES_(apply) \
    apply(sphere, Sphere) apply(capsule, Capsule) apply(box, Box) apply(oriented_box, OrientedBox) apply(cone, Cone)

#endif
