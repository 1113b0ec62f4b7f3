/* Queries that may err, always on the safe side, by as much as you allow. Counterpart of approximate.hpp.
 *
 * `accuracy` is in the blob's units. The query adds its work to `counters` unless that is null. */
#ifndef ESPALIER_C_APPROXIMATE_H
#define ESPALIER_C_APPROXIMATE_H

#include <espalier/c/attributes.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/shapes.h>
#include <espalier/c/advanced/statistics.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Return whether the surface may overlap the shape. A no is certain. */
espalier_yes_no espalier_overlaps_sphere_approximate(const espalier_blob* blob, const espalier_sphere* sphere,
                                                     float accuracy, espalier_query_counters* counters);
espalier_yes_no espalier_overlaps_box_approximate(const espalier_blob* blob, const espalier_box* box, float accuracy,
                                                  espalier_query_counters* counters);
/* Returns whether the ray may hit the surface. A no is certain. */
espalier_yes_no espalier_occluded_approximate(const espalier_blob* blob, const espalier_ray* ray, float accuracy,
                                              espalier_query_counters* counters);

/* The value is meaningful only if the status is ESPALIER_QUERY_OK. */
typedef struct ESPALIER_SHARED_ espalier_distance_bounds_result {
    struct {
        float lower, upper;
    } value;
    espalier_query_status status;
} espalier_distance_bounds_result;

/* Returns a lower and an upper bound on the distance from the point to the surface. */
espalier_distance_bounds_result espalier_distance_bounds(const espalier_blob* blob, espalier_vec3 point,
                                                         float max_distance, float accuracy,
                                                         espalier_query_counters* counters);

#ifdef __cplusplus
}
#endif

#endif
