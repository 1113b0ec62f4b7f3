// espalier/c/advanced/rounding.h: how far a query moves when it is rounded.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

#define ROUNDING_ERROR(name) \
    ESPALIER_C_FUNCTION(espalier_rounding_error_##name, (blob, shape), c(rounding_error(cpp(blob), cpp(shape))))
#define ROUNDING_ERROR_SWEEP(name)                                                         \
    ESPALIER_C_FUNCTION(espalier_rounding_error_sweep_##name, (blob, shape, displacement), \
                        c(rounding_error(cpp(blob), cpp(shape), cpp(displacement))))

ROUNDING_ERROR(point)
ROUNDING_ERROR(ray)
ROUNDING_ERROR(segment)
ROUNDING_ERROR(sphere)
ROUNDING_ERROR(capsule)
ROUNDING_ERROR(box)
ROUNDING_ERROR(oriented_box)
ROUNDING_ERROR(triangle)
ESPALIER_C_SWEPT_SHAPES(ROUNDING_ERROR_SWEEP)
