// espalier.h: queries in whole lattice steps.
#include <runtime/c/overlaps.hpp>

using namespace espalier;
using namespace espalier::detail;

extern "C" {

espalier_lattice espalier_lattice_of(const espalier_blob* blob) { return twin_value(lattice_of(*twin(blob))); }

espalier_query_status espalier_to_steps(const espalier_lattice* lattice, const espalier_vec3* world,
                                        espalier_steps* steps) {
    return static_cast<espalier_query_status>(to_steps(*twin(lattice), *twin(world), *twin(steps)));
}

espalier_query_status espalier_steps_around(const espalier_lattice* lattice, const espalier_box* world,
                                            espalier_box_in_steps* box) {
    return static_cast<espalier_query_status>(steps_around(*twin(lattice), *twin(world), *twin(box)));
}

espalier_vec3 espalier_to_world(const espalier_lattice* lattice, const espalier_steps* steps) {
    return twin_value(to_world(*twin(lattice), *twin(steps)));
}

bool espalier_overlaps_box_in_steps(const espalier_blob* blob, const espalier_box_in_steps* box) {
    return overlaps(*twin(blob), *twin(box));
}

bool espalier_for_each_overlap_box_in_steps(const espalier_blob* blob, const espalier_box_in_steps* box,
                                            espalier_triangle_visitor visit, void* user) {
    return for_each(blob, *twin(box), visit, user);
}

espalier_overlap_page espalier_collect_overlaps_box_in_steps(const espalier_blob* blob,
                                                             const espalier_box_in_steps* box, espalier_triangle* page,
                                                             size_t places, uint32_t first) {
    return collect(blob, *twin(box), page, places, first);
}

espalier_query_status espalier_first_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment,
                                         espalier_hit_in_steps* hit) {
    return static_cast<espalier_query_status>(first_hit(*twin(blob), *twin(segment), *twin(hit)));
}

espalier_query_status espalier_any_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment, bool* hit) {
    return static_cast<espalier_query_status>(any_hit(*twin(blob), *twin(segment), *hit));
}

}  // extern "C"
