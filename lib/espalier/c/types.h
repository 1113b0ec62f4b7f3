/* Plain values that queries take and return. Counterpart of types.hpp. */
#ifndef ESPALIER_C_TYPES_H
#define ESPALIER_C_TYPES_H

#include <stdint.h>

#include <espalier/c/attributes.h>

/* A point or a direction. */
typedef struct ESPALIER_SHARED_ espalier_vec3 {
    float x, y, z;
} espalier_vec3;

/* A place in the units and axes of the source, which float32 would round too coarsely far from 0. */
typedef struct ESPALIER_SHARED_ espalier_vec3d {
    double x, y, z;
} espalier_vec3d;

/* The index of a triangle in its blob. A miss has ESPALIER_NO_TRIANGLE. */
typedef uint32_t espalier_triangle_id;
#define ESPALIER_NO_TRIANGLE UINT32_C(0xFFFFFFFF)

/* Three corners, counter-clockwise seen from the front: a shape, and the baked corners of a triangle. */
typedef struct ESPALIER_SHARED_ espalier_triangle {
    espalier_vec3 a, b, c;
} espalier_triangle;

/* The part of a triangle that a point lies on, and the smallest of several: a corner, else an edge, else the face. */
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

/* A side of a triangle. The corners run counter-clockwise when seen from the front. */
typedef uint8_t espalier_side;
enum { ESPALIER_SIDE_FRONT = 0, ESPALIER_SIDE_BACK = 1 };

/* Selects the faces that a query ignores: triangles that show their back, or their front. */
typedef uint8_t espalier_face_culling;
enum { ESPALIER_FACE_CULLING_NONE = 0, ESPALIER_FACE_CULLING_BACK = 1, ESPALIER_FACE_CULLING_FRONT = 2 };

/* The source of a triangle: the input file, the mesh in that file and the triangle of that mesh, counted from 0. */
typedef struct ESPALIER_SHARED_ espalier_original_triangle {
    uint32_t file, mesh, triangle;
    uint32_t first_corner;
} espalier_original_triangle;

#endif
