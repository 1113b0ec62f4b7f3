// espalier/c/distance.h: closest points, distances, inside.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

ESPALIER_C_FUNCTION(espalier_closest_point, (blob, point, max_distance),
                    c(closest_point(cpp(blob), cpp(point), max_distance)))

ESPALIER_C_FUNCTION(espalier_closest_point_segment, (blob, segment, max_distance),
                    c(closest_point(cpp(blob), cpp(segment), max_distance)))

ESPALIER_C_FUNCTION(espalier_closest_point_box, (blob, box, max_distance),
                    c(closest_point(cpp(blob), cpp(box), max_distance)))

ESPALIER_C_FUNCTION(espalier_closest_triangles, (blob, point, nearest, capacity, max_distance),
                    c(closest_triangles(cpp(blob), cpp(point), cpp(nearest, capacity), max_distance)))

ESPALIER_C_FUNCTION(espalier_contains, (blob, point), c(contains(cpp(blob), cpp(point))))

ESPALIER_C_FUNCTION(espalier_winding_number, (blob, point, directions),
                    c(espalier::winding_number(cpp(blob), cpp(point), directions)))

ESPALIER_C_FUNCTION(espalier_signed_distance, (blob, point, max_distance),
                    c(signed_distance(cpp(blob), cpp(point), max_distance)))
