// espalier.h: rays.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

espalier_ray espalier_ray_from(espalier_vec3 origin, espalier_vec3 direction) {
    return {origin, direction, 0.0f, __builtin_inff(), ESPALIER_FACES_BOTH};
}

espalier_ray espalier_along(const espalier_segment* segment) { return twin_value(along(*twin(segment))); }

bool espalier_raycast(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit) {
    return raycast(*twin(blob), *twin(ray), *twin(hit));
}

bool espalier_raycast_filtered(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit,
                               espalier_triangle_filter filter, void* user) {
    const Filter counts = {filter, user};
    return raycast(*twin(blob), *twin(ray), *twin(hit), counts);
}

bool espalier_occluded(const espalier_blob* blob, const espalier_ray* ray) { return occluded(*twin(blob), *twin(ray)); }

bool espalier_occluded_filtered(const espalier_blob* blob, const espalier_ray* ray, espalier_triangle_filter filter,
                                void* user) {
    const Filter counts = {filter, user};
    return occluded(*twin(blob), *twin(ray), counts);
}

espalier_hit_count espalier_closest_hits(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hits,
                                         size_t places) {
    return twin_value(closest_hits(*twin(blob), *twin(ray), twins(hits, places)));
}

espalier_hit_count espalier_closest_hits_filtered(const espalier_blob* blob, const espalier_ray* ray,
                                                  espalier_ray_hit* hits, size_t places,
                                                  espalier_triangle_filter filter, void* user) {
    const Filter counts = {filter, user};
    return twin_value(closest_hits(*twin(blob), *twin(ray), twins(hits, places), counts));
}

size_t espalier_raycast_batch(const espalier_blob* blob, const espalier_ray* rays, espalier_ray_hit* hits,
                              size_t count) {
    return raycast(*twin(blob), twins(rays, count), twins(hits, count));
}

size_t espalier_occluded_batch(const espalier_blob* blob, const espalier_ray* rays, uint8_t* answers, size_t count) {
    return occluded(*twin(blob), twins(rays, count), std::span(answers, count));
}

bool espalier_for_each_hit(const espalier_blob* blob, const espalier_ray* ray, espalier_hit_visitor visit, void* user) {
    if (visit == nullptr) return false;
    return for_each_hit(*twin(blob), *twin(ray),
                        [=](const RayHit& hit) { return visit_answer(visit(twin(&hit), user)); });
}

bool espalier_raycast_counted(const espalier_blob* blob, const espalier_ray* ray, espalier_ray_hit* hit,
                              espalier_query_counters* counters) {
    return raycast_counted(*twin(blob), *twin(ray), *twin(hit), *twin(counters));
}

espalier_query_status espalier_lattice_of_blobs(const espalier_blob* blobs, size_t count, espalier_lattice* region) {
    return static_cast<espalier_query_status>(lattice_of(twins(blobs, count), *twin(region)));
}

espalier_query_status espalier_round_ray(const espalier_lattice* region, const espalier_ray* ray,
                                         espalier_rounded_ray* rounded) {
    *twin(rounded) = round_ray(*twin(region), *twin(ray));
    return static_cast<espalier_query_status>(twin(rounded)->status());
}

espalier_query_status espalier_raycast_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray,
                                               espalier_ray_hit* hit) {
    return static_cast<espalier_query_status>(raycast(*twin(blob), *twin(ray), *twin(hit)));
}

espalier_query_status espalier_occluded_rounded(const espalier_blob* blob, const espalier_rounded_ray* ray, bool* hit) {
    return static_cast<espalier_query_status>(occluded(*twin(blob), *twin(ray), *hit));
}

}  // extern "C"
