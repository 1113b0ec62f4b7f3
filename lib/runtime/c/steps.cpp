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

ESPALIER_C_OVERLAPS(box_in_steps, espalier_box_in_steps)

espalier_query_status espalier_first_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment,
                                         espalier_hit_in_steps* hit) {
    return static_cast<espalier_query_status>(first_hit(*twin(blob), *twin(segment), *twin(hit)));
}

espalier_query_status espalier_any_hit(const espalier_blob* blob, const espalier_segment_in_steps* segment, bool* hit) {
    return static_cast<espalier_query_status>(any_hit(*twin(blob), *twin(segment), *hit));
}

}  // extern "C"
