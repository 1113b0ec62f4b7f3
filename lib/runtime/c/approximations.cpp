// espalier/c/approximate.h: queries that may err.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_yes_no espalier_overlaps_sphere_approximate(const espalier_blob* blob, const espalier_sphere* sphere,
                                                     float accuracy, espalier_query_counters* counters) {
    return c(overlaps(cpp(blob), cpp(sphere), espalier::Accuracy{accuracy}, twin(counters)));
}

espalier_yes_no espalier_overlaps_box_approximate(const espalier_blob* blob, const espalier_box* box, float accuracy,
                                                  espalier_query_counters* counters) {
    return c(overlaps(cpp(blob), cpp(box), espalier::Accuracy{accuracy}, twin(counters)));
}

espalier_yes_no espalier_occluded_approximate(const espalier_blob* blob, const espalier_ray* ray, float accuracy,
                                              espalier_query_counters* counters) {
    return c(occluded(cpp(blob), cpp(ray), espalier::Accuracy{accuracy}, twin(counters)));
}

espalier_distance_bounds_result espalier_distance_bounds(const espalier_blob* blob, espalier_vec3 point,
                                                         float max_distance, float accuracy,
                                                         espalier_query_counters* counters) {
    return c(distance_bounds(cpp(blob), cpp(point), max_distance, espalier::Accuracy{accuracy}, twin(counters)));
}
