// How far queries move when they are rounded.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "rays.hpp"
#include "shapes/batches.hpp"

#include <espalier/advanced/rounding.hpp>

namespace espalier::python {

namespace {

py::array of_points(const HeldBlob& self, const py::handle& given, unsigned threads) {
    Floats points(given, "points", {3}, origin_of(self.blob));
    const Batch batch({&points});
    const auto point = points.as<Vec3>();
    py::array results = batch.results(dtype_of("length"));
    answer_each(static_cast<Result<float>*>(results.mutable_data()), batch.count(), threads,
                [&](std::size_t i) { return rounding_error(self.blob, point.at(i)); });
    return results;
}

py::array of_rays(const HeldBlob& self, const py::handle& origins, const py::handle& directions, unsigned threads) {
    const Rays rays(origins, directions, py::float_(0.0), py::float_(0.0), 0, origin_of(self.blob));
    py::array results = rays.batch.results(dtype_of("length"));
    answer_each(static_cast<Result<float>*>(results.mutable_data()), rays.batch.count(), threads,
                [&](std::size_t i) { return rounding_error(self.blob, rays.arrays.at(i)); });
    return results;
}

py::array of_shapes(const HeldBlob& self, const std::string& kind, const py::tuple& given, unsigned threads) {
    return answer_shapes(
        {kind, given, origin_of(self.blob)}, nullptr, dtype_of("length"),
        threads, [&](const auto& shape, std::size_t) requires requires { rounding_error(self.blob, shape); } {
            return rounding_error(self.blob, shape);
        });
}

py::array of_sweeps(const HeldBlob& self, const std::string& kind, const py::tuple& given,
                    const py::handle& displacement, unsigned threads) {
    Floats ways(displacement, "displacement", {3});
    return answer_shapes(
        {kind, given, origin_of(self.blob)}, &ways, dtype_of("length"),
        threads, [&](const auto& shape, std::size_t i) requires requires { rounding_error(self.blob, shape, Vec3{}); } {
            return rounding_error(self.blob, shape, ways.as<Vec3>().at(i));
        });
}

}  // namespace

void bind_rounding(py::module_& module) {
    module.def("rounding_of_points", of_points);
    module.def("rounding_of_rays", of_rays);
    module.def("rounding_of_shapes", of_shapes);
    module.def("rounding_of_sweeps", of_sweeps);
}

}  // namespace espalier::python
