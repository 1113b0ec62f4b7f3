/* The plain values that queries take and return. Counterpart of types.hpp. */
#ifndef ESPALIER_C_TYPES_H
#define ESPALIER_C_TYPES_H

#include <stdint.h>

#include <espalier/c/attributes.h>

/* A point or a direction. */
typedef struct ESPALIER_SHARED_ espalier_vec3 {
    float x, y, z;
} espalier_vec3;

/* A point in the units and axes of the source, in double because float32 is too coarse far from the origin. */
typedef struct ESPALIER_SHARED_ espalier_vec3d {
    double x, y, z;
} espalier_vec3d;

/* The index of a triangle in its blob. A miss has ESPALIER_NO_TRIANGLE. */
typedef uint32_t espalier_triangle_id;
#define ESPALIER_NO_TRIANGLE UINT32_C(0xFFFFFFFF)

/* Three corners, counter-clockwise as seen from the front. Serves as a query shape and as the corners of a baked
 * triangle. */
typedef struct ESPALIER_SHARED_ espalier_triangle {
    espalier_vec3 a, b, c;
} espalier_triangle;

/* The part of a triangle that a point lies on. A point that lies on several is given the smallest: a corner before an
 * edge, an edge before the face. */
typedef uint8_t espalier_feature;
enum {
    ESPALIER_FEATURE_FACE = 0,
    ESPALIER_FEATURE_EDGE_AB = 1,
    ESPALIER_FEATURE_EDGE_BC = 2,
    ESPALIER_FEATURE_EDGE_CA = 3,
    ESPALIER_FEATURE_VERTEX_A = 4,
    ESPALIER_FEATURE_VERTEX_B = 5,
    ESPALIER_FEATURE_VERTEX_C = 6
};

/* A side of a triangle, whose corners run counter-clockwise as seen from the front. */
typedef uint8_t espalier_side;
enum { ESPALIER_SIDE_FRONT = 0, ESPALIER_SIDE_BACK = 1 };

/* Which triangles a query ignores: none, those that show it their back, or those that show it their front. */
typedef uint8_t espalier_face_culling;
enum { ESPALIER_FACE_CULLING_NONE = 0, ESPALIER_FACE_CULLING_BACK = 1, ESPALIER_FACE_CULLING_FRONT = 2 };

/* Identifies a source triangle by its input file, the mesh in that file and the triangle in that mesh, all counted from
 * 0. */
typedef struct ESPALIER_SHARED_ espalier_original_triangle {
    uint32_t file, mesh, triangle;
    uint32_t first_corner;
} espalier_original_triangle;

#endif
