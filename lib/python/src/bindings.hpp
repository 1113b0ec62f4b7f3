// The parts of the extension module. Its functions take and return arrays; the Python files of the package give them
// names, default arguments and documentation.
#pragma once

#include <pybind11/pybind11.h>

namespace espalier::python {

void bind_bake(pybind11::module_& module);
void bind_blob(pybind11::module_& module);
void bind_lookups(pybind11::module_& module);
void bind_rays(pybind11::module_& module);
void bind_points(pybind11::module_& module);
void bind_overlaps(pybind11::module_& module);
void bind_sweeps(pybind11::module_& module);
void bind_contacts(pybind11::module_& module);
void bind_edges(pybind11::module_& module);
void bind_rounding(pybind11::module_& module);
void bind_approximations(pybind11::module_& module);
void bind_bounds(pybind11::module_& module);
void bind_pairs(pybind11::module_& module);
void bind_baked_scenes(pybind11::module_& module);
void bind_moving_scenes(pybind11::module_& module);
void bind_scene_queries(pybind11::module_& module);
void bind_scene_pairs(pybind11::module_& module);
void bind_scene_contacts(pybind11::module_& module);
void bind_transforms(pybind11::module_& module);

}  // namespace espalier::python
