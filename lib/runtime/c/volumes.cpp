// espalier.h: volumes.
#include <runtime/c/overlaps.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

bool espalier_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere) {
    return overlaps(*twin(blob), *twin(sphere));
}

bool espalier_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule) {
    return overlaps(*twin(blob), *twin(capsule));
}

bool espalier_overlaps_box(const espalier_blob* blob, const espalier_box* box) {
    return overlaps(*twin(blob), *twin(box));
}

bool espalier_overlaps_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box) {
    return overlaps(*twin(blob), *twin(box));
}

bool espalier_overlaps_triangle(const espalier_blob* blob, const espalier_corners* triangle) {
    return overlaps(*twin(blob), *twin(triangle));
}

bool espalier_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count) {
    return overlaps(*twin(blob), twins(planes, plane_count));
}

bool espalier_for_each_overlap_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                      espalier_triangle_visitor visit, void* user) {
    return for_each(blob, *twin(sphere), visit, user);
}

bool espalier_for_each_overlap_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                       espalier_triangle_visitor visit, void* user) {
    return for_each(blob, *twin(capsule), visit, user);
}

bool espalier_for_each_overlap_box(const espalier_blob* blob, const espalier_box* box, espalier_triangle_visitor visit,
                                   void* user) {
    return for_each(blob, *twin(box), visit, user);
}

bool espalier_for_each_overlap_oriented_box(const espalier_blob* blob, const espalier_oriented_box* box,
                                            espalier_triangle_visitor visit, void* user) {
    return for_each(blob, *twin(box), visit, user);
}

bool espalier_for_each_overlap_triangle(const espalier_blob* blob, const espalier_corners* triangle,
                                        espalier_triangle_visitor visit, void* user) {
    return for_each(blob, *twin(triangle), visit, user);
}

bool espalier_for_each_overlap_planes(const espalier_blob* blob, const espalier_plane* planes, size_t plane_count,
                                      espalier_triangle_visitor visit, void* user) {
    return for_each(blob, twins(planes, plane_count), visit, user);
}

espalier_overlap_page espalier_collect_overlaps_sphere(const espalier_blob* blob, const espalier_sphere* sphere,
                                                       espalier_triangle* page, size_t places, uint32_t first) {
    return collect(blob, *twin(sphere), page, places, first);
}

espalier_overlap_page espalier_collect_overlaps_capsule(const espalier_blob* blob, const espalier_capsule* capsule,
                                                        espalier_triangle* page, size_t places, uint32_t first) {
    return collect(blob, *twin(capsule), page, places, first);
}

espalier_overlap_page espalier_collect_overlaps_box(const espalier_blob* blob, const espalier_box* box,
                                                    espalier_triangle* page, size_t places, uint32_t first) {
    return collect(blob, *twin(box), page, places, first);
}

espalier_overlap_page espalier_collect_overlaps_oriented_box(const espalier_blob* blob,
                                                             const espalier_oriented_box* box, espalier_triangle* page,
                                                             size_t places, uint32_t first) {
    return collect(blob, *twin(box), page, places, first);
}

espalier_overlap_page espalier_collect_overlaps_triangle(const espalier_blob* blob, const espalier_corners* triangle,
                                                         espalier_triangle* page, size_t places, uint32_t first) {
    return collect(blob, *twin(triangle), page, places, first);
}

espalier_overlap_page espalier_collect_overlaps_planes(const espalier_blob* blob, const espalier_plane* planes,
                                                       size_t plane_count, espalier_triangle* page, size_t places,
                                                       uint32_t first) {
    return collect(blob, twins(planes, plane_count), page, places, first);
}

}  // extern "C"
