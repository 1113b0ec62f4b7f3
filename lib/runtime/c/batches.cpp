// espalier/c/batches: batches of rays, shapes and lookups in arrays.
#include <limits>

#include <runtime/c/abi.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

constexpr std::size_t size_limit = std::numeric_limits<std::size_t>::max();

std::span<QueryStatus> in_cpp(espalier_query_status* statuses, std::size_t count) {
    return {reinterpret_cast<QueryStatus*>(statuses), count};
}

/// Fills rows of `places` elements by a batch of C++.
template <class Element, class Batch>
espalier_filled fill_rows(Element* elements, std::size_t places, std::size_t count, Batch batch) {
    if (places != 0 && count > size_limit / sizeof(Element) / places)
        return {0, {{0, 0, 0}}, ESPALIER_QUERY_INVALID_ARGUMENT};
    return c(batch(cpp(elements, count * places)));
}

}  // namespace

ESPALIER_C_FUNCTION(espalier_raycast_arrays, (blob, rays, hits, count),
                    c(raycast(cpp(blob), cpp(rays), cpp(hits, count))))

ESPALIER_C_FUNCTION(espalier_occluded_arrays, (blob, rays, answers, count),
                    c(occluded(cpp(blob), cpp(rays), cpp(answers, count))))

ESPALIER_C_FUNCTION(espalier_closest_hits_arrays, (blob, rays, hits, places, found, count),
                    fill_rows(hits, places, count,
                              [&](auto rows) { return closest_hits(cpp(blob), cpp(rays), rows, cpp(found, count)); }))

ESPALIER_C_FUNCTION(espalier_collect_hits_arrays, (blob, rays, statuses, offsets, count, hits, capacity),
                    c(collect_hits(cpp(blob), cpp(rays), in_cpp(statuses, count), {offsets, count + 1},
                                   cpp(hits, capacity))))

ESPALIER_C_FUNCTION(espalier_collect_crossings_arrays, (blob, rays, statuses, offsets, count, crossings, capacity),
                    c(collect_crossings(cpp(blob), cpp(rays), in_cpp(statuses, count), {offsets, count + 1},
                                        cpp(crossings, capacity))))

ESPALIER_C_FUNCTION(espalier_closest_point_arrays, (blob, points, nearest, count, max_distance),
                    c(closest_point(cpp(blob), cpp(points), cpp(nearest, count), max_distance)))

ESPALIER_C_FUNCTION(espalier_signed_distance_arrays, (blob, points, nearest, count, max_distance),
                    c(signed_distance(cpp(blob), cpp(points), cpp(nearest, count), max_distance)))

ESPALIER_C_FUNCTION(espalier_contains_arrays, (blob, points, answers, count),
                    c(contains(cpp(blob), cpp(points), cpp(answers, count))))

ESPALIER_C_FUNCTION(espalier_closest_triangles_arrays, (blob, points, nearest, places, found, count, max_distance),
                    fill_rows(nearest, places, count, [&](auto rows) {
                        return closest_triangles(cpp(blob), cpp(points), rows, cpp(found, count), max_distance);
                    }))

/// Defines the batches of overlaps with a shape.
#define OVERLAPS_ARRAYS(name)                                                                                     \
    ESPALIER_C_FUNCTION(espalier_overlaps_##name##_arrays, (blob, shapes, answers, count),                        \
                        c(overlaps(cpp(blob), cpp(shapes), cpp(answers, count))))                                 \
    ESPALIER_C_FUNCTION(espalier_collect_overlaps_##name##_arrays,                                                \
                        (blob, shapes, statuses, offsets, count, triangles, capacity),                            \
                        c(collect_overlaps(cpp(blob), cpp(shapes), in_cpp(statuses, count), {offsets, count + 1}, \
                                           cpp(triangles, capacity))))

OVERLAPS_ARRAYS(sphere)
OVERLAPS_ARRAYS(box)

ESPALIER_C_FUNCTION(espalier_original_triangle_of_arrays, (blob, triangles, originals, count),
                    c(original_triangle(cpp(blob), cpp(triangles), cpp(originals, count))))

ESPALIER_C_FUNCTION(espalier_material_arrays, (blob, triangles, materials, count),
                    c(material(cpp(blob), cpp(triangles), {materials, count})))

ESPALIER_C_FUNCTION(espalier_triangle_at_arrays, (blob, triangles, corners, count),
                    c(triangle_at(cpp(blob), cpp(triangles), cpp(corners, count))))

ESPALIER_C_FUNCTION(espalier_triangle_data_arrays, (blob, triangles, data, count),
                    c(triangle_data(cpp(blob), cpp(triangles), cpp(data, count))))
