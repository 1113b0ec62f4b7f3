// espalier/c/advanced/lattice.h: queries in whole lattice steps.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

espalier_lattice_point_result espalier_to_lattice_point(const espalier_lattice* lattice, const espalier_vec3* local) {
    return c(to_lattice(cpp(lattice), cpp(local)));
}

espalier_lattice_box_result espalier_to_lattice_box(const espalier_lattice* lattice, const espalier_box* local) {
    return c(to_lattice(cpp(lattice), cpp(local)));
}

espalier_vec3 espalier_to_local(const espalier_lattice* lattice, const espalier_lattice_point* steps) {
    return c(to_local(cpp(lattice), cpp(steps)));
}

espalier_lattice_hit espalier_raycast_lattice_segment(const espalier_blob* blob,
                                                      const espalier_lattice_segment* segment) {
    return c(raycast(cpp(blob), cpp(segment)));
}

espalier_yes_no espalier_occluded_lattice_segment(const espalier_blob* blob, const espalier_lattice_segment* segment) {
    return c(occluded(cpp(blob), cpp(segment)));
}
