// Batches over arrays of shapes: one call of the functions of C for each.
#include <cstddef>
#include <cstdint>

#include <espalier/c/blob.h>
#include <espalier/c/distance.h>
#include <espalier/c/overlap.h>
#include <espalier/c/shapes.h>
#include <espalier/c/sweep.h>

#include "flags.hpp"
#include "lists.hpp"

namespace {

espalier_visit add_triangle(espalier_triangle_id triangle, const espalier_triangle*, void* user) {
    return espalier::wasm::add_to_room(&triangle, user);
}

/// Returns options that keep the triangles with a flag; null keeps all.
espalier_sweep_options with_flags(espalier_sweep_options options, espalier_flags* only) {
    options.filter = only == nullptr ? nullptr : espalier::wasm::keeps_triangle;
    options.user = only;
    return options;
}

}  // namespace

// Each function begins with where it writes, as C's own that return a structure.

#define ESPALIER_WASM_OVERLAPS(shape)                                                                              \
    extern "C" [[clang::export_name("wasm_overlaps_" #shape)]] void wasm_overlaps_##shape(                         \
        espalier_yes_no* answers, const espalier_blob* blob, const espalier_##shape* shapes, std::size_t count) {  \
        for (std::size_t i = 0; i < count; ++i) answers[i] = espalier_overlaps_##shape(blob, &shapes[i]);          \
    }                                                                                                              \
    extern "C" [[clang::export_name("wasm_collect_overlaps_" #shape)]] void wasm_collect_overlaps_##shape(         \
        espalier_filled_lists* filled, const espalier_blob* blob, const espalier_##shape* shapes,                  \
        espalier_query_status* statuses, std::size_t* offsets, std::size_t count, espalier_triangle_id* triangles, \
        std::size_t capacity) {                                                                                    \
        *filled = espalier::wasm::collect_lists<espalier_triangle_id>(                                             \
            count, {statuses, offsets, triangles, capacity}, [&](std::size_t i, auto& room) {                      \
                return espalier_for_each_overlap_##shape(blob, &shapes[i], add_triangle, &room);                   \
            });                                                                                                    \
    }

ESPALIER_WASM_OVERLAPS(sphere)
ESPALIER_WASM_OVERLAPS(capsule)
ESPALIER_WASM_OVERLAPS(box)
ESPALIER_WASM_OVERLAPS(oriented_box)
ESPALIER_WASM_OVERLAPS(cone)
ESPALIER_WASM_OVERLAPS(triangle)
ESPALIER_WASM_OVERLAPS(convex_volume)

#define ESPALIER_WASM_SWEEP(shape)                                                                          \
    extern "C" [[clang::export_name("wasm_sweep_" #shape)]] void wasm_sweep_##shape(                        \
        espalier_sweep_hit* hits, const espalier_blob* blob, const espalier_##shape* shapes,                \
        const espalier_vec3* displacements, std::size_t count, const espalier_sweep_options* options,       \
        espalier_flags* only) {                                                                             \
        const espalier_sweep_options filtered = with_flags(*options, only);                                 \
        for (std::size_t i = 0; i < count; ++i)                                                             \
            hits[i] = espalier_sweep_##shape##_with_options(blob, &shapes[i], displacements[i], &filtered); \
    }

ESPALIER_WASM_SWEEP(sphere)
ESPALIER_WASM_SWEEP(capsule)
ESPALIER_WASM_SWEEP(box)
ESPALIER_WASM_SWEEP(oriented_box)
ESPALIER_WASM_SWEEP(convex_hull)

#define ESPALIER_WASM_CLOSEST(shape)                                                                       \
    extern "C" [[clang::export_name("wasm_closest_point_" #shape)]] void wasm_closest_point_##shape(       \
        espalier_closest_point_result* nearest, const espalier_blob* blob, const espalier_##shape* shapes, \
        std::size_t count, float max_distance) {                                                           \
        for (std::size_t i = 0; i < count; ++i)                                                            \
            nearest[i] = espalier_closest_point_##shape(blob, &shapes[i], max_distance);                   \
    }

ESPALIER_WASM_CLOSEST(segment)
ESPALIER_WASM_CLOSEST(box)

/// Writes how often the surface winds around each point.
extern "C" [[clang::export_name("wasm_winding_number")]] void wasm_winding_number(espalier_float_result* numbers,
                                                                                  const espalier_blob* blob,
                                                                                  const espalier_vec3* points,
                                                                                  std::size_t count,
                                                                                  std::uint32_t directions) {
    for (std::size_t i = 0; i < count; ++i) numbers[i] = espalier_winding_number(blob, points[i], directions);
}
