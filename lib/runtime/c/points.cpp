// espalier/c/distance.h: closest points, distances, inside.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_closest_point_result espalier_closest_point(const espalier_blob* blob, espalier_vec3 point,
                                                     float max_distance) {
    return c(closest_point(cpp(blob), cpp(point), max_distance));
}

espalier_closest_point_result espalier_closest_point_segment(const espalier_blob* blob, const espalier_segment* segment,
                                                             float max_distance) {
    return c(closest_point(cpp(blob), cpp(segment), max_distance));
}

espalier_closest_point_result espalier_closest_point_box(const espalier_blob* blob, const espalier_box* box,
                                                         float max_distance) {
    return c(closest_point(cpp(blob), cpp(box), max_distance));
}

espalier_filled espalier_closest_triangles(const espalier_blob* blob, espalier_vec3 point,
                                           espalier_closest_point_result* nearest, size_t capacity,
                                           float max_distance) {
    return c(closest_triangles(cpp(blob), cpp(point), cpp(nearest, capacity), max_distance));
}

espalier_yes_no espalier_contains(const espalier_blob* blob, espalier_vec3 point) {
    return c(contains(cpp(blob), cpp(point)));
}

espalier_float_result espalier_winding_number(const espalier_blob* blob, espalier_vec3 point, uint32_t directions) {
    return c(espalier::winding_number(cpp(blob), cpp(point), directions));
}

espalier_closest_point_result espalier_signed_distance(const espalier_blob* blob, espalier_vec3 point,
                                                       float max_distance) {
    return c(signed_distance(cpp(blob), cpp(point), max_distance));
}
