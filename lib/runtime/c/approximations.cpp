// espalier.h: queries that may err.
#include <runtime/c/twins.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

bool espalier_may_overlap_sphere(const espalier_blob* blob, const espalier_sphere* sphere, float accuracy,
                                 espalier_query_counters* counters) {
    return may_overlap(*twin(blob), *twin(sphere), accuracy, twin(counters));
}

bool espalier_may_overlap_box(const espalier_blob* blob, const espalier_box* box, float accuracy,
                              espalier_query_counters* counters) {
    return may_overlap(*twin(blob), *twin(box), accuracy, twin(counters));
}

bool espalier_may_be_occluded(const espalier_blob* blob, const espalier_ray* ray, float accuracy,
                              espalier_query_counters* counters) {
    return may_be_occluded(*twin(blob), *twin(ray), accuracy, twin(counters));
}

bool espalier_get_distance_bounds(const espalier_blob* blob, espalier_vec3 point, float max_distance, float accuracy,
                                  espalier_distance_bounds* bounds, espalier_query_counters* counters) {
    return distance_bounds(*twin(blob), twin_value(point), max_distance, accuracy, *twin(bounds), twin(counters));
}

}  // extern "C"
