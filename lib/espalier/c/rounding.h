/* Rounding bounds: how far a query moves when it is rounded. Counterpart of rounding.hpp. */
#ifndef ESPALIER_C_ROUNDING_H
#define ESPALIER_C_ROUNDING_H

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/shapes.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The value counts only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_float_result {
    float value;
    espalier_query_status status;
} espalier_float_result;

/* Returns how far rounding moves the query at most, in the blob's units. */
espalier_float_result espalier_rounding_error_point(const espalier_blob* blob, espalier_vec3 point);
espalier_float_result espalier_rounding_error_ray(const espalier_blob* blob, const espalier_ray* ray);
espalier_float_result espalier_rounding_error_segment(const espalier_blob* blob, const espalier_segment* segment);
espalier_float_result espalier_rounding_error_sphere(const espalier_blob* blob, const espalier_sphere* sphere);
espalier_float_result espalier_rounding_error_capsule(const espalier_blob* blob, const espalier_capsule* capsule);
espalier_float_result espalier_rounding_error_box(const espalier_blob* blob, const espalier_box* box);
espalier_float_result espalier_rounding_error_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box);
espalier_float_result espalier_rounding_error_triangle(const espalier_blob* blob, const espalier_triangle* triangle);

/* Returns how far rounding moves the shape of a sweep at most, at its start and on its way. */
espalier_float_result espalier_rounding_error_sweep_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                           espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                            espalier_vec3 displacement);
espalier_float_result espalier_rounding_error_sweep_box(const espalier_blob* blob, const espalier_box* box,
                                                        espalier_vec3 displacement);

#ifdef __cplusplus
}
#endif

#endif
