/* Placing blobs and shapes: rotations, transforms, and blobs at a position in the world. Counterpart of
 * transform.hpp. */
#ifndef ESPALIER_C_TRANSFORM_H
#define ESPALIER_C_TRANSFORM_H

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A rotation, of any length but zero. */
typedef struct ESPALIER_SHARED_ espalier_quaternion {
    float x, y, z, w;
} espalier_quaternion;

/* Leads from local space to the world: x becomes rotation * (scale * x) + translation. A transform of zeros is not
 * valid. */
typedef struct ESPALIER_SHARED_ espalier_transform {
    espalier_quaternion rotation;
    espalier_vec3 translation;
    float scale;
} espalier_transform;

typedef struct ESPALIER_SHARED_ espalier_transform_result {
    espalier_transform value;
    espalier_query_status status;
} espalier_transform_result;

/* A blob at a position in the world, for the queries on two blobs in pair.h. All other queries take an espalier_blob:
 * move their shapes with espalier_to_local_sphere() and so on. It refers to the blob, which must outlive it. */
typedef struct ESPALIER_SHARED_ espalier_placed_blob {
    const espalier_blob* blob;
    espalier_transform transform;
} espalier_placed_blob;

/* Returns the identity {{0, 0, 0, 1}, {0, 0, 0}, 1}, which leaves every point where it is. */
espalier_transform espalier_identity(void);

/* Move a point or a shape from the world into the local space of the transform. */
espalier_vec3 espalier_to_local_point(const espalier_transform* transform, espalier_vec3 point);
espalier_segment espalier_to_local_segment(const espalier_transform* transform, const espalier_segment* segment);
espalier_sphere espalier_to_local_sphere(const espalier_transform* transform, const espalier_sphere* sphere);
espalier_capsule espalier_to_local_capsule(const espalier_transform* transform, const espalier_capsule* capsule);
espalier_triangle espalier_to_local_triangle(const espalier_transform* transform, const espalier_triangle* triangle);
espalier_oriented_box espalier_to_local_box(const espalier_transform* transform, const espalier_box* box);
espalier_oriented_box espalier_to_local_oriented_box(const espalier_transform* transform,
                                                     const espalier_oriented_box* box);
espalier_cone espalier_to_local_cone(const espalier_transform* transform, const espalier_cone* cone);
espalier_plane espalier_to_local_plane(const espalier_transform* transform, const espalier_plane* plane);
espalier_ray espalier_to_local_ray(const espalier_transform* transform, const espalier_ray* ray);
/* Returns the transform from the local space of `inner` to that of `outer`. */
espalier_transform espalier_to_local_transform(const espalier_transform* outer, const espalier_transform* inner);
/* Rotates and scales a direction or a displacement, without translating it. */
espalier_vec3 espalier_direction_to_local(const espalier_transform* transform, espalier_vec3 direction);
/* Moves a point from local space into the world. */
espalier_vec3 espalier_to_world_point(const espalier_transform* transform, espalier_vec3 point);
/* Rotates and scales a direction or a displacement, without translating it. */
espalier_vec3 espalier_direction_to_world(const espalier_transform* transform, espalier_vec3 direction);
/* Rotates a normal without scaling it. */
espalier_vec3 espalier_normal_to_world(const espalier_transform* transform, espalier_vec3 normal);

/* Return a point or a shape moved by a displacement. */
espalier_vec3 espalier_translated_point(espalier_vec3 point, espalier_vec3 displacement);
espalier_segment espalier_translated_segment(const espalier_segment* segment, espalier_vec3 displacement);
espalier_sphere espalier_translated_sphere(const espalier_sphere* sphere, espalier_vec3 displacement);
espalier_capsule espalier_translated_capsule(const espalier_capsule* capsule, espalier_vec3 displacement);
espalier_triangle espalier_translated_triangle(const espalier_triangle* triangle, espalier_vec3 displacement);
espalier_box espalier_translated_box(const espalier_box* box, espalier_vec3 displacement);
espalier_oriented_box espalier_translated_oriented_box(const espalier_oriented_box* box, espalier_vec3 displacement);
espalier_cone espalier_translated_cone(const espalier_cone* cone, espalier_vec3 displacement);
espalier_ray espalier_translated_ray(const espalier_ray* ray, espalier_vec3 displacement);

/* Converts an affine matrix to a transform: three rows of four numbers each. */
espalier_transform_result espalier_transform_from_matrix(const float rows[12]);

#ifdef __cplusplus
}
#endif

#endif
