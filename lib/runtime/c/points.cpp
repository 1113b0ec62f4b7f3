// espalier.h: closest points, distances, inside.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

bool espalier_closest_point(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                            espalier_nearest* nearest) {
    return closest_point(*twin(blob), twin_value(point), max_distance, *twin(nearest));
}

size_t espalier_closest_triangles(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                                  espalier_nearest* nearest, size_t places) {
    return closest_triangles(*twin(blob), twin_value(point), max_distance, twins(nearest, places));
}

espalier_query_status espalier_closest_to_segment(const espalier_blob* blob, const espalier_segment* segment,
                                                  float max_distance, espalier_nearest_pair* pair) {
    return static_cast<espalier_query_status>(
        closest_to_segment(*twin(blob), *twin(segment), max_distance, *twin(pair)));
}

espalier_query_status espalier_closest_to_box(const espalier_blob* blob, const espalier_box* box, float max_distance,
                                              espalier_nearest_pair* pair) {
    return static_cast<espalier_query_status>(closest_to_box(*twin(blob), *twin(box), max_distance, *twin(pair)));
}

espalier_query_status espalier_contains(const espalier_blob* blob, espalier_vec3 point, bool* inside) {
    return static_cast<espalier_query_status>(contains(*twin(blob), twin_value(point), *inside));
}

espalier_query_status espalier_signed_distance(const espalier_blob* blob, espalier_vec3 point, float max_distance,
                                               espalier_nearest* nearest) {
    return static_cast<espalier_query_status>(
        signed_distance(*twin(blob), twin_value(point), max_distance, *twin(nearest)));
}

}  // extern "C"
