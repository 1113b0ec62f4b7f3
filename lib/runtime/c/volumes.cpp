// espalier.h: volumes.
#include <runtime/c/overlaps.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

ESPALIER_C_OVERLAPS(sphere, espalier_sphere)
ESPALIER_C_OVERLAPS(capsule, espalier_capsule)
ESPALIER_C_OVERLAPS(box, espalier_box)
ESPALIER_C_OVERLAPS(oriented_box, espalier_oriented_box)
ESPALIER_C_OVERLAPS(triangle, espalier_corners)

bool espalier_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count) {
    return overlaps(*twin(blob), twins(planes, plane_count));
}

bool espalier_for_each_overlap_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count,
                                      espalier_triangle_visitor visit, void* user) {
    return for_each(blob, twins(planes, plane_count), visit, user);
}

espalier_overlap_page espalier_collect_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes,
                                                       size_t plane_count, espalier_triangle* page, size_t places,
                                                       uint32_t first) {
    return collect(blob, twins(planes, plane_count), page, places, first);
}

}  // extern "C"
