// espalier/c/ray.h, of statistics.h what casts rays, and of rounding.h what casts rays that are rounded once.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

ESPALIER_C_FUNCTION(espalier_default_ray, (origin, direction),
                    {origin, direction, 0.0f, espalier::infinity, ESPALIER_FACE_CULLING_NONE})

ESPALIER_C_FUNCTION(espalier_ray_between, (from, to), c(espalier::Ray::between(cpp(from), cpp(to))))

/// Defines the functions that cast a ray, or one that is rounded.
#define RAY_QUERIES(suffix)                                                                       \
    ESPALIER_C_FUNCTION(espalier_raycast##suffix, (blob, ray), c(raycast(cpp(blob), cpp(ray))))   \
    ESPALIER_C_FUNCTION(espalier_raycast##suffix##_filtered, (blob, ray, filter, user),           \
                        c(raycast(cpp(blob), cpp(ray), Filter{filter, user})))                    \
    ESPALIER_C_FUNCTION(espalier_occluded##suffix, (blob, ray), c(occluded(cpp(blob), cpp(ray)))) \
    ESPALIER_C_FUNCTION(espalier_occluded##suffix##_filtered, (blob, ray, filter, user),          \
                        c(occluded(cpp(blob), cpp(ray), Filter{filter, user})))                   \
    ESPALIER_C_VISITING(espalier_for_each_hit##suffix, (blob, ray, visit, user),                  \
                        c(for_each_hit(cpp(blob), cpp(ray), visitor(visit, user))))               \
    ESPALIER_C_VISITING(espalier_for_each_crossing##suffix, (blob, ray, visit, user),             \
                        c(for_each_crossing(cpp(blob), cpp(ray), visitor(visit, user))))

RAY_QUERIES()
RAY_QUERIES(_rounded)

ESPALIER_C_FUNCTION(espalier_closest_hits, (blob, ray, hits, capacity),
                    c(closest_hits(cpp(blob), cpp(ray), cpp(hits, capacity))))

ESPALIER_C_FUNCTION(espalier_closest_hits_filtered, (blob, ray, hits, capacity, filter, user),
                    c(closest_hits(cpp(blob), cpp(ray), cpp(hits, capacity), Filter{filter, user})))

ESPALIER_C_FUNCTION(espalier_raycast_batch, (blob, rays, hits, count),
                    c(raycast(cpp(blob), cpp(rays, count), cpp(hits, count))))

ESPALIER_C_FUNCTION(espalier_occluded_batch, (blob, rays, answers, count),
                    c(occluded(cpp(blob), cpp(rays, count), cpp(answers, count))))

ESPALIER_C_FUNCTION(espalier_raycast_counted, (blob, ray, counters), c(raycast(cpp(blob), cpp(ray), cpp(counters))))

ESPALIER_C_FUNCTION(espalier_lattice_of_blobs, (blobs, count), c(lattice_of(cpp(blobs, count))))

ESPALIER_C_FUNCTION(espalier_round_ray, (region, ray), c(round_ray(cpp(region), cpp(ray))))

espalier_query_status espalier_rounded_ray_status(const espalier_rounded_ray* ray) { return c(cpp(ray).status()); }

ESPALIER_C_FUNCTION(espalier_to_local_rounded_ray, (transform, ray), c(to_local(cpp(transform), cpp(ray))))
