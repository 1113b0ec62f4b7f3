// Moving shapes against one blob.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "parts.hpp"
#include "shapes.hpp"

#include <espalier/sweep.hpp>

namespace espalier::python {

namespace {

py::array sweeps(const HeldBlob& self, const std::string& kind, const py::tuple& given, const py::handle& displacement,
                 unsigned threads) {
    if (kind == "Segment" || kind == "Triangle" || kind == "Cone" || kind == "ConvexVolume") refuse_shape(kind);
    ShapeFields fields;
    return with_shape(kind, given, fields, [&](const auto& at) -> py::array {
        Floats displacements(displacement, "displacement", {3});
        const Batch batch = spread(fields, &displacements);
        const auto way = displacements.as<Vec3>();
        py::array results = batch.results(dtype_of("sweep_hit"));
        answer_each(static_cast<SweepHit*>(results.mutable_data()), batch.count(), threads, [&](std::size_t i) {
            return at(i, [&](const auto& shape) {
                if constexpr (requires { sweep(self.blob, shape, Vec3{}); }) return sweep(self.blob, shape, way.at(i));
                else return SweepHit{};
            });
        });
        return results;
    });
}

}  // namespace

void bind_sweeps(py::module_& module) { module.def("sweeps", sweeps); }

}  // namespace espalier::python
