// Moving shapes against one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "flags.hpp"
#include "held_blob.hpp"
#include "shapes/batches.hpp"
#include "shapes/sweeps.hpp"

#include <espalier/sweep.hpp>

namespace espalier::python {

namespace {

py::array sweeps(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& displacement,
                 const GivenSweepOptions& given_options, const py::object& only, unsigned threads) {
    const Flags flags(only);
    auto options = sweep_options<SweepOptions>(given_options);
    options.filter = flags.of_triangles();
    Floats ways(displacement, "displacement", {3});
    return answer_shapes(
        {kind, given, origin_of(self.blob)}, &ways, dtype_of("sweep_hit"),
        threads, [&](const auto& shape, std::size_t i) requires requires { sweep(self.blob, shape, Vec3{}); } {
            return sweep(self.blob, shape, ways.as<Vec3>().at(i), options);
        });
}

}  // namespace

void bind_sweeps(py::module_& module) { module.def("sweeps", sweeps); }

}  // namespace espalier::python
