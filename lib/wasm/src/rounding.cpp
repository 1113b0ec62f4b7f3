// How far queries of an array are rounded, and approximate ones: one call of the functions of C for each.
#include <cstddef>

#include <espalier/c/approximate.h>
#include <espalier/c/ray.h>
#include <espalier/c/advanced/rounding.h>

extern "C" [[clang::export_name("wasm_rounding_error_point")]] void wasm_rounding_error_point(
    espalier_float_result* errors, const espalier_blob* blob, const espalier_vec3* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) errors[i] = espalier_rounding_error_point(blob, points[i]);
}

#define ESPALIER_WASM_ROUNDING(shape)                                                                                  \
    extern "C" [[clang::export_name("wasm_rounding_error_" #shape)]] void wasm_rounding_error_##shape(                 \
        espalier_float_result* errors, const espalier_blob* blob, const espalier_##shape* shapes, std::size_t count) { \
        for (std::size_t i = 0; i < count; ++i) errors[i] = espalier_rounding_error_##shape(blob, &shapes[i]);         \
    }
#define ESPALIER_WASM_ROUNDING_OF_SWEEP(shape)                                                                     \
    extern "C" [[clang::export_name("wasm_rounding_error_sweep_" #shape)]] void wasm_rounding_error_sweep_##shape( \
        espalier_float_result* errors, const espalier_blob* blob, const espalier_##shape* shapes,                  \
        const espalier_vec3* displacements, std::size_t count) {                                                   \
        for (std::size_t i = 0; i < count; ++i)                                                                    \
            errors[i] = espalier_rounding_error_sweep_##shape(blob, &shapes[i], displacements[i]);                 \
    }

ESPALIER_WASM_ROUNDING(ray)
ESPALIER_WASM_ROUNDING(segment)
ESPALIER_WASM_ROUNDING(sphere)
ESPALIER_WASM_ROUNDING(capsule)
ESPALIER_WASM_ROUNDING(box)
ESPALIER_WASM_ROUNDING(oriented_box)
ESPALIER_WASM_ROUNDING(triangle)
ESPALIER_WASM_ROUNDING_OF_SWEEP(sphere)
ESPALIER_WASM_ROUNDING_OF_SWEEP(capsule)
ESPALIER_WASM_ROUNDING_OF_SWEEP(box)
ESPALIER_WASM_ROUNDING_OF_SWEEP(oriented_box)
ESPALIER_WASM_ROUNDING_OF_SWEEP(convex_hull)

extern "C" [[clang::export_name("wasm_occluded_approximate")]] void wasm_occluded_approximate(
    espalier_yes_no* answers, const espalier_blob* blob, const espalier_ray* rays, std::size_t count, float accuracy) {
    for (std::size_t i = 0; i < count; ++i)
        answers[i] = espalier_occluded_approximate(blob, &rays[i], accuracy, nullptr);
}

extern "C" [[clang::export_name("wasm_overlaps_sphere_approximate")]] void wasm_overlaps_sphere_approximate(
    espalier_yes_no* answers, const espalier_blob* blob, const espalier_sphere* spheres, std::size_t count,
    float accuracy) {
    for (std::size_t i = 0; i < count; ++i)
        answers[i] = espalier_overlaps_sphere_approximate(blob, &spheres[i], accuracy, nullptr);
}

extern "C" [[clang::export_name("wasm_overlaps_box_approximate")]] void wasm_overlaps_box_approximate(
    espalier_yes_no* answers, const espalier_blob* blob, const espalier_box* boxes, std::size_t count, float accuracy) {
    for (std::size_t i = 0; i < count; ++i)
        answers[i] = espalier_overlaps_box_approximate(blob, &boxes[i], accuracy, nullptr);
}

extern "C" [[clang::export_name("wasm_distance_bounds")]] void wasm_distance_bounds(
    espalier_distance_bounds_result* bounds, const espalier_blob* blob, const espalier_vec3* points, std::size_t count,
    float max_distance, float accuracy) {
    for (std::size_t i = 0; i < count; ++i)
        bounds[i] = espalier_distance_bounds(blob, points[i], max_distance, accuracy, nullptr);
}
