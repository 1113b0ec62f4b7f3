// espalier/c/ray.h, of statistics.h what casts rays, and of rounding.h what casts rays that are rounded once.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_ray espalier_default_ray(espalier_vec3 origin, espalier_vec3 direction) {
    return {origin, direction, 0.0f, espalier::infinity, ESPALIER_FACE_CULLING_NONE};
}

espalier_ray espalier_ray_between(espalier_vec3 from, espalier_vec3 to) {
    return c(espalier::Ray::between(cpp(from), cpp(to)));
}

/// Defines the functions that cast a ray, or one that is rounded.
#define RAY_QUERIES(suffix, Ray)                                                                        \
    espalier_ray_hit espalier_raycast##suffix(const espalier_blob* blob, const Ray* ray) {              \
        return c(raycast(cpp(blob), cpp(ray)));                                                         \
    }                                                                                                   \
    espalier_ray_hit espalier_raycast##suffix##_filtered(const espalier_blob* blob, const Ray* ray,     \
                                                         espalier_triangle_filter filter, void* user) { \
        return c(raycast(cpp(blob), cpp(ray), Filter{filter, user}));                                   \
    }                                                                                                   \
    espalier_yes_no espalier_occluded##suffix(const espalier_blob* blob, const Ray* ray) {              \
        return c(occluded(cpp(blob), cpp(ray)));                                                        \
    }                                                                                                   \
    espalier_yes_no espalier_occluded##suffix##_filtered(const espalier_blob* blob, const Ray* ray,     \
                                                         espalier_triangle_filter filter, void* user) { \
        return c(occluded(cpp(blob), cpp(ray), Filter{filter, user}));                                  \
    }                                                                                                   \
    espalier_query_status espalier_for_each_hit##suffix(const espalier_blob* blob, const Ray* ray,      \
                                                        espalier_hit_visitor visit, void* user) {       \
        if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;                                   \
        return c(for_each_hit(cpp(blob), cpp(ray), visitor(visit, user)));                              \
    }                                                                                                   \
    espalier_query_status espalier_for_each_crossing##suffix(const espalier_blob* blob, const Ray* ray, \
                                                             espalier_hit_visitor visit, void* user) {  \
        if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;                                   \
        return c(for_each_crossing(cpp(blob), cpp(ray), visitor(visit, user)));                         \
    }

RAY_QUERIES(, espalier_ray)
RAY_QUERIES(_rounded, espalier_rounded_ray)

espalier_filled espalier_closest_hits(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hits,
                                      size_t capacity) {
    return c(closest_hits(cpp(blob), cpp(ray), cpp(hits, capacity)));
}

espalier_filled espalier_closest_hits_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                               espalier_ray_hit* hits, size_t capacity, espalier_triangle_filter filter,
                                               void* user) {
    return c(closest_hits(cpp(blob), cpp(ray), cpp(hits, capacity), Filter{filter, user}));
}

espalier_filled espalier_raycast_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_ray_hit* hits,
                                       size_t count) {
    return c(raycast(cpp(blob), cpp(rays, count), cpp(hits, count)));
}

espalier_filled espalier_occluded_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_yes_no* answers,
                                        size_t count) {
    return c(occluded(cpp(blob), cpp(rays, count), cpp(answers, count)));
}

espalier_ray_hit espalier_raycast_counted(const espalier_blob* blob, const espalier_ray* ray,
                                          espalier_query_counters* counters) {
    return c(raycast(cpp(blob), cpp(ray), cpp(counters)));
}

espalier_lattice_result espalier_lattice_of_blobs(const espalier_blob* blobs, size_t count) {
    return c(lattice_of(cpp(blobs, count)));
}

espalier_rounded_ray espalier_round_ray(const espalier_lattice* region, const espalier_ray* ray) {
    return c(round_ray(cpp(region), cpp(ray)));
}

espalier_query_status espalier_rounded_ray_status(const espalier_rounded_ray* ray) { return c(cpp(ray).status()); }

espalier_rounded_ray espalier_to_local_rounded_ray(const espalier_transform* transform,
                                                   const espalier_rounded_ray* ray) {
    return c(to_local(cpp(transform), cpp(ray)));
}
