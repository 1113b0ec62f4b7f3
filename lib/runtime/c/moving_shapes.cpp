// espalier/c/sweep.h: shapes that move.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

#define SWEEP(name)                                                                                                  \
    espalier_sweep_hit espalier_sweep_##name(const espalier_blob* blob, const espalier_##name* shape,                \
                                             espalier_vec3 displacement) {                                           \
        return c(sweep(cpp(blob), cpp(shape), cpp(displacement)));                                                   \
    }                                                                                                                \
    espalier_sweep_hit espalier_sweep_##name##_filtered(const espalier_blob* blob, const espalier_##name* shape,     \
                                                        espalier_vec3 displacement, espalier_triangle_filter filter, \
                                                        void* user) {                                                \
        return c(sweep(cpp(blob), cpp(shape), cpp(displacement), Filter{filter, user}));                             \
    }

SWEEP(sphere)
SWEEP(capsule)
SWEEP(box)
SWEEP(oriented_box)
SWEEP(convex_hull)
