// espalier/c/overlap.h: overlaps.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

/// Defines the functions that test, visit and collect overlaps with a shape.
#define OVERLAPS(name, Cpp)                                                                                         \
    espalier_yes_no espalier_overlaps_##name(const espalier_blob* blob, const espalier_##name* shape) {             \
        return c(overlaps(cpp(blob), cpp(shape)));                                                                  \
    }                                                                                                               \
    espalier_query_status espalier_for_each_overlap_##name(const espalier_blob* blob, const espalier_##name* shape, \
                                                           espalier_triangle_visitor visit, void* user) {           \
        if (visit == nullptr) return ESPALIER_QUERY_INVALID_ARGUMENT;                                               \
        return c(for_each_overlap(cpp(blob), cpp(shape), visitor(visit, user)));                                    \
    }                                                                                                               \
    espalier_filled espalier_collect_overlaps_##name(const espalier_blob* blob, const espalier_##name* shape,       \
                                                     espalier_triangle_id* out, size_t capacity,                    \
                                                     espalier_cursor from) {                                        \
        return c(collect_overlaps(cpp(blob), cpp(shape), cpp(out, capacity), cpp(from)));                           \
    }

ESPALIER_SHAPES_(OVERLAPS)
OVERLAPS(triangle, Triangle)
OVERLAPS(convex_volume, ConvexVolume)
OVERLAPS(lattice_box, LatticeBox)
