// espalier/c/advanced/lattice.h: queries in whole lattice steps.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

ESPALIER_C_FUNCTION(espalier_to_lattice_point, (lattice, local), c(to_lattice(cpp(lattice), cpp(local))))

ESPALIER_C_FUNCTION(espalier_to_lattice_box, (lattice, local), c(to_lattice(cpp(lattice), cpp(local))))

ESPALIER_C_FUNCTION(espalier_to_local, (lattice, steps), c(to_local(cpp(lattice), cpp(steps))))

ESPALIER_C_FUNCTION(espalier_raycast_lattice_segment, (blob, segment), c(raycast(cpp(blob), cpp(segment))))

ESPALIER_C_FUNCTION(espalier_occluded_lattice_segment, (blob, segment), c(occluded(cpp(blob), cpp(segment))))
