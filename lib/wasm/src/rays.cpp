// Batches of rays that hit some of the triangles: one call of the functions of C for each. Those that hit all are C's
// own.
#include <cstddef>
#include <cstring>

#include <espalier/c/batches/rays.h>
#include <espalier/c/blob.h>
#include <espalier/c/ray.h>
#include <espalier/c/status.h>
#include <espalier/c/types.h>

#include "flags.hpp"

namespace {

template <class Value, class Strided>
Value element(const Strided& array, std::size_t i) {
    Value value;
    std::memcpy(&value, static_cast<const std::byte*>(array.first) + static_cast<std::ptrdiff_t>(i) * array.stride,
                sizeof value);
    return value;
}

espalier_ray ray_at(const espalier_ray_arrays& rays, std::size_t i) {
    return {element<espalier_vec3>(rays.origins, i), element<espalier_vec3>(rays.directions, i),
            element<float>(rays.t_min, i), element<float>(rays.t_max, i), rays.culling};
}

/// Calls use(i, ray) for each ray.
template <class Use>
void for_each_ray(const espalier_ray_arrays& rays, std::size_t count, Use use) {
    for (std::size_t i = 0; i < count; ++i) {
        const espalier_ray ray = ray_at(rays, i);
        use(i, &ray);
    }
}

}  // namespace

// Each function begins with where it writes, as C's own that return a structure.

extern "C" [[clang::export_name("wasm_raycast_filtered")]] void wasm_raycast_filtered(espalier_ray_hit* hits,
                                                                                      const espalier_blob* blob,
                                                                                      const espalier_ray_arrays* rays,
                                                                                      std::size_t count,
                                                                                      espalier_flags* only) {
    for_each_ray(*rays, count, [&](std::size_t i, const espalier_ray* ray) {
        hits[i] = espalier_raycast_filtered(blob, ray, espalier::wasm::keeps_triangle, only);
    });
}

extern "C" [[clang::export_name("wasm_occluded_filtered")]] void wasm_occluded_filtered(espalier_yes_no* answers,
                                                                                        const espalier_blob* blob,
                                                                                        const espalier_ray_arrays* rays,
                                                                                        std::size_t count,
                                                                                        espalier_flags* only) {
    for_each_ray(*rays, count, [&](std::size_t i, const espalier_ray* ray) {
        answers[i] = espalier_occluded_filtered(blob, ray, espalier::wasm::keeps_triangle, only);
    });
}

// Each ray has `places` places in `hits`, of which found[i].count are filled.
extern "C" [[clang::export_name("wasm_closest_hits_filtered")]] void wasm_closest_hits_filtered(
    espalier_ray_hit* hits, std::size_t places, espalier_filled* found, const espalier_blob* blob,
    const espalier_ray_arrays* rays, std::size_t count, espalier_flags* only) {
    for_each_ray(*rays, count, [&](std::size_t i, const espalier_ray* ray) {
        found[i] =
            espalier_closest_hits_filtered(blob, ray, hits + i * places, places, espalier::wasm::keeps_triangle, only);
    });
}
