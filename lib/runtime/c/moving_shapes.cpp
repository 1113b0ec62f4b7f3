// espalier/c/sweep.h: shapes that move.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

namespace {

/// Returns options of C as C++ takes them, with a filter that outlives the call.
espalier::SweepOptions cpp(const espalier_sweep_options& options, const Filter& filter) {
    espalier::SweepOptions result;
    if (options.filter != nullptr) result.filter = filter;
    result.culling = static_cast<espalier::FaceCulling>(options.culling);
    result.ignore_leaving = options.ignore_leaving;
    result.skin = options.skin;
    return result;
}

}  // namespace

#define SWEEP(name)                                                                                                  \
    espalier_sweep_hit espalier_sweep_##name(const espalier_blob* blob, const espalier_##name* shape,                \
                                             espalier_vec3 displacement) {                                           \
        return c(sweep(cpp(blob), cpp(shape), cpp(displacement)));                                                   \
    }                                                                                                                \
    espalier_sweep_hit espalier_sweep_##name##_filtered(const espalier_blob* blob, const espalier_##name* shape,     \
                                                        espalier_vec3 displacement, espalier_triangle_filter filter, \
                                                        void* user) {                                                \
        return c(sweep(cpp(blob), cpp(shape), cpp(displacement), Filter{filter, user}));                             \
    }                                                                                                                \
    espalier_sweep_hit espalier_sweep_##name##_with_options(const espalier_blob* blob, const espalier_##name* shape, \
                                                            espalier_vec3 displacement,                              \
                                                            const espalier_sweep_options* options) {                 \
        const Filter filter{options->filter, options->user};                                                         \
        return c(sweep(cpp(blob), cpp(shape), cpp(displacement), cpp(*options, filter)));                            \
    }

SWEEP(sphere)
SWEEP(capsule)
SWEEP(box)
SWEEP(oriented_box)
SWEEP(convex_hull)
