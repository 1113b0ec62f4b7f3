// espalier/c/overlap.h: overlaps.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

/// Defines the functions that test, visit and collect overlaps with a shape.
#define OVERLAPS(name, Cpp)                                                                          \
    ESPALIER_C_FUNCTION(espalier_overlaps_##name, (blob, shape), c(overlaps(cpp(blob), cpp(shape)))) \
    ESPALIER_C_VISITING(espalier_for_each_overlap_##name, (blob, shape, visit, user),                \
                        c(for_each_overlap(cpp(blob), cpp(shape), visitor(visit, user))))            \
    ESPALIER_C_FUNCTION(espalier_collect_overlaps_##name, (blob, shape, out, capacity, from),        \
                        c(collect_overlaps(cpp(blob), cpp(shape), cpp(out, capacity), cpp(from))))

ESPALIER_SHAPES_(OVERLAPS)
OVERLAPS(triangle, Triangle)
OVERLAPS(convex_volume, ConvexVolume)
OVERLAPS(lattice_box, LatticeBox)
