// The structured NumPy types of the library's results: their fields lie where those of the C++ structures do, so that
// results are written once.
#pragma once

#include <pybind11/numpy.h>

namespace espalier::python {

namespace py = pybind11;

/// Returns the type of a result by the name of its structure, such as "ray_hit". Throws KeyError for other names.
py::dtype dtype_of(const char* name);

/// Adds all types to the module, as a dictionary by name.
void bind_dtypes(py::module_& module);

}  // namespace espalier::python
