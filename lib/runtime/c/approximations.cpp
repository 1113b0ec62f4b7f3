// espalier/c/approximate.h: queries that may err.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

ESPALIER_C_FUNCTION(espalier_overlaps_sphere_approximate, (blob, sphere, accuracy, counters),
                    c(overlaps(cpp(blob), cpp(sphere), espalier::Accuracy{accuracy}, twin(counters))))

ESPALIER_C_FUNCTION(espalier_overlaps_box_approximate, (blob, box, accuracy, counters),
                    c(overlaps(cpp(blob), cpp(box), espalier::Accuracy{accuracy}, twin(counters))))

ESPALIER_C_FUNCTION(espalier_occluded_approximate, (blob, ray, accuracy, counters),
                    c(occluded(cpp(blob), cpp(ray), espalier::Accuracy{accuracy}, twin(counters))))

ESPALIER_C_FUNCTION(espalier_distance_bounds, (blob, point, max_distance, accuracy, counters),
                    c(distance_bounds(cpp(blob), cpp(point), max_distance, espalier::Accuracy{accuracy},
                                      twin(counters))))
