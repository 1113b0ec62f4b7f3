// The extension module espalier._core.
#include "bindings.hpp"
#include "dtypes.hpp"

#include <espalier/c/abi.h>

using namespace espalier::python;

PYBIND11_MODULE(_core, module) {
    module.doc() = "The compiled part of espalier. Its functions may change; use those of the package.";
    module.attr("version") = ESPALIER_VERSION;
    bind_dtypes(module);
    bind_blob(module);
    bind_bake(module);
    bind_lookups(module);
    bind_rays(module);
    bind_points(module);
    bind_overlaps(module);
    bind_sweeps(module);
    bind_contacts(module);
    bind_edges(module);
    bind_rounding(module);
    bind_approximations(module);
    bind_bounds(module);
    bind_pairs(module);
    bind_transforms(module);
    bind_baked_scenes(module);
    bind_moving_scenes(module);
    bind_scene_queries(module);
    bind_scene_pairs(module);
    bind_scene_contacts(module);
}
