// espalier/c/batches: batches of rays, shapes and lookups in arrays.
#include <limits>

#include <runtime/c/abi.hpp>

using namespace espalier;
using namespace espalier::detail;

namespace {

constexpr std::size_t size_limit = std::numeric_limits<std::size_t>::max();
constexpr espalier_filled nothing_filled = {0, {{0, 0, 0}}, ESPALIER_QUERY_INVALID_ARGUMENT};
constexpr espalier_filled_lists no_lists_filled = {0, 0, 0, ESPALIER_QUERY_INVALID_ARGUMENT};

bool is_missing(const void* results, std::size_t count) { return results == nullptr && count != 0; }

/// Fills results by a batch of C++.
template <class Results, class Batch>
espalier_filled fill_in_cpp(Results* results, std::size_t count, Batch batch) {
    return is_missing(results, count) ? nothing_filled : c(batch(cpp(results, count)));
}

/// Fills rows of `places` elements by a batch of C++.
template <class Element, class Batch>
espalier_filled fill_rows_in_cpp(Element* elements, std::size_t places, espalier_filled* found, std::size_t count,
                                 Batch batch) {
    if (is_missing(found, count)) return nothing_filled;
    if (places != 0 && (is_missing(elements, count) || count > size_limit / sizeof(Element) / places))
        return nothing_filled;
    return c(batch(cpp(elements, count * places), cpp(found, count)));
}

/// Fills lists by a batch of C++.
template <class Element, class Batch>
espalier_filled_lists fill_lists_in_cpp(espalier_query_status* statuses, std::size_t* offsets, std::size_t count,
                                        Element* elements, std::size_t capacity, Batch batch) {
    if (offsets == nullptr || is_missing(statuses, count) || is_missing(elements, capacity) || count == size_limit)
        return no_lists_filled;
    const std::span<QueryStatus> each_status(reinterpret_cast<QueryStatus*>(statuses), count);
    return c(batch(each_status, std::span(offsets, count + 1), cpp(elements, capacity)));
}

}  // namespace

espalier_filled espalier_raycast_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                        espalier_ray_hit* hits, size_t count) {
    return fill_in_cpp(hits, count, [&](auto out) { return raycast(cpp(blob), cpp(rays), out); });
}

espalier_filled espalier_occluded_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                         espalier_yes_no* answers, size_t count) {
    return fill_in_cpp(answers, count, [&](auto out) { return occluded(cpp(blob), cpp(rays), out); });
}

espalier_filled espalier_closest_hits_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                             espalier_ray_hit* hits, size_t places, espalier_filled* found,
                                             size_t count) {
    return fill_rows_in_cpp(hits, places, found, count,
                            [&](auto out, auto filled) { return closest_hits(cpp(blob), cpp(rays), out, filled); });
}

espalier_filled_lists espalier_collect_hits_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                                   espalier_query_status* statuses, size_t* offsets, size_t count,
                                                   espalier_ray_hit* hits, size_t capacity) {
    return fill_lists_in_cpp(statuses, offsets, count, hits, capacity, [&](auto each, auto ends, auto out) {
        return collect_hits(cpp(blob), cpp(rays), each, ends, out);
    });
}

espalier_filled_lists espalier_collect_crossings_arrays(const espalier_blob* blob, const espalier_ray_arrays* rays,
                                                        espalier_query_status* statuses, size_t* offsets, size_t count,
                                                        espalier_ray_hit* crossings, size_t capacity) {
    return fill_lists_in_cpp(statuses, offsets, count, crossings, capacity, [&](auto each, auto ends, auto out) {
        return collect_crossings(cpp(blob), cpp(rays), each, ends, out);
    });
}

espalier_filled espalier_closest_point_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                              espalier_closest_point_result* nearest, size_t count,
                                              float max_distance) {
    return fill_in_cpp(nearest, count,
                       [&](auto out) { return closest_point(cpp(blob), cpp(points), out, max_distance); });
}

espalier_filled espalier_signed_distance_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                                espalier_closest_point_result* nearest, size_t count,
                                                float max_distance) {
    return fill_in_cpp(nearest, count,
                       [&](auto out) { return signed_distance(cpp(blob), cpp(points), out, max_distance); });
}

espalier_filled espalier_contains_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                         espalier_yes_no* answers, size_t count) {
    return fill_in_cpp(answers, count, [&](auto out) { return contains(cpp(blob), cpp(points), out); });
}

espalier_filled espalier_closest_triangles_arrays(const espalier_blob* blob, espalier_strided_vec3 points,
                                                  espalier_closest_point_result* nearest, size_t places,
                                                  espalier_filled* found, size_t count, float max_distance) {
    return fill_rows_in_cpp(nearest, places, found, count, [&](auto out, auto filled) {
        return closest_triangles(cpp(blob), cpp(points), out, filled, max_distance);
    });
}

espalier_filled espalier_overlaps_sphere_arrays(const espalier_blob* blob, const espalier_sphere_arrays* spheres,
                                                espalier_yes_no* answers, size_t count) {
    return fill_in_cpp(answers, count, [&](auto out) { return overlaps(cpp(blob), cpp(spheres), out); });
}

espalier_filled espalier_overlaps_box_arrays(const espalier_blob* blob, const espalier_box_arrays* boxes,
                                             espalier_yes_no* answers, size_t count) {
    return fill_in_cpp(answers, count, [&](auto out) { return overlaps(cpp(blob), cpp(boxes), out); });
}

espalier_filled_lists espalier_collect_overlaps_sphere_arrays(const espalier_blob* blob,
                                                              const espalier_sphere_arrays* spheres,
                                                              espalier_query_status* statuses, size_t* offsets,
                                                              size_t count, espalier_triangle_id* triangles,
                                                              size_t capacity) {
    return fill_lists_in_cpp(statuses, offsets, count, triangles, capacity, [&](auto each, auto ends, auto out) {
        return collect_overlaps(cpp(blob), cpp(spheres), each, ends, out);
    });
}

espalier_filled_lists espalier_collect_overlaps_box_arrays(const espalier_blob* blob, const espalier_box_arrays* boxes,
                                                           espalier_query_status* statuses, size_t* offsets,
                                                           size_t count, espalier_triangle_id* triangles,
                                                           size_t capacity) {
    return fill_lists_in_cpp(statuses, offsets, count, triangles, capacity, [&](auto each, auto ends, auto out) {
        return collect_overlaps(cpp(blob), cpp(boxes), each, ends, out);
    });
}

espalier_filled espalier_original_triangle_of_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                                     espalier_original_triangle_result* originals, size_t count) {
    return fill_in_cpp(originals, count, [&](auto out) { return original_triangle(cpp(blob), cpp(triangles), out); });
}

espalier_filled espalier_material_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                         uint16_t* materials, size_t count) {
    if (is_missing(materials, count)) return nothing_filled;
    return c(material(cpp(blob), cpp(triangles), std::span(materials, count)));
}

espalier_filled espalier_triangle_at_arrays(const espalier_blob* blob, espalier_strided_triangle_id triangles,
                                            espalier_triangle_result* corners, size_t count) {
    return fill_in_cpp(corners, count, [&](auto out) { return triangle_at(cpp(blob), cpp(triangles), out); });
}
