// espalier/c/advanced/rounding.h: how far a query moves when it is rounded.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

#define ROUNDING_ERROR(name)                                                                                        \
    espalier_float_result espalier_rounding_error_##name(const espalier_blob* blob, const espalier_##name* shape) { \
        return c(rounding_error(cpp(blob), cpp(shape)));                                                            \
    }
#define ROUNDING_ERROR_SWEEP(name)                                                             \
    espalier_float_result espalier_rounding_error_sweep_##name(                                \
        const espalier_blob* blob, const espalier_##name* shape, espalier_vec3 displacement) { \
        return c(rounding_error(cpp(blob), cpp(shape), cpp(displacement)));                    \
    }

espalier_float_result espalier_rounding_error_point(const espalier_blob* blob, espalier_vec3 point) {
    return c(rounding_error(cpp(blob), cpp(point)));
}

ROUNDING_ERROR(ray)
ROUNDING_ERROR(segment)
ROUNDING_ERROR(sphere)
ROUNDING_ERROR(capsule)
ROUNDING_ERROR(box)
ROUNDING_ERROR(oriented_box)
ROUNDING_ERROR(triangle)

ROUNDING_ERROR_SWEEP(sphere)
ROUNDING_ERROR_SWEEP(capsule)
ROUNDING_ERROR_SWEEP(box)
ROUNDING_ERROR_SWEEP(oriented_box)
ROUNDING_ERROR_SWEEP(convex_hull)
