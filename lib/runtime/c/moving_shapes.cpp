// espalier/c/sweep.h: shapes that move.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

namespace {

/// A null filter is none: no triangle is passed to it.
espalier::SweepOptions cpp(const espalier_sweep_options& options, const Filter& filter) {
    if (options.filter == nullptr) return sweep_options<espalier::SweepOptions>(options, espalier::TriangleFilter());
    return sweep_options<espalier::SweepOptions>(options, filter);
}

}  // namespace

#define SWEEP(name)                                                                                  \
    ESPALIER_C_FUNCTION(espalier_sweep_##name, (blob, shape, displacement),                          \
                        c(sweep(cpp(blob), cpp(shape), cpp(displacement))))                          \
    ESPALIER_C_FUNCTION(espalier_sweep_##name##_filtered, (blob, shape, displacement, filter, user), \
                        c(sweep(cpp(blob), cpp(shape), cpp(displacement), Filter{filter, user})))    \
    ESPALIER_C_FUNCTION(                                                                             \
        espalier_sweep_##name##_with_options, (blob, shape, displacement, options),                  \
        c(sweep(cpp(blob), cpp(shape), cpp(displacement), cpp(*options, Filter{options->filter, options->user}))))

ESPALIER_C_SWEPT_SHAPES(SWEEP)
