// Queries that may err by an accuracy, on the safe side.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "rays.hpp"
#include "shapes/batches.hpp"

#include <espalier/approximate.hpp>

namespace espalier::python {

namespace {

py::array nearly_occluded(const HeldBlob& self, const py::handle& origins, const py::handle& directions,
                          const py::handle& t_min, const py::handle& t_max, int culling, float accuracy,
                          unsigned threads) {
    const Rays rays(origins, directions, t_min, t_max, culling, origin_of(self.blob));
    py::array results = rays.batch.results(py::dtype::of<std::uint8_t>());
    answer_each(static_cast<YesNo*>(results.mutable_data()), rays.batch.count(), threads,
                [&](std::size_t i) { return occluded(self.blob, rays.arrays.at(i), Accuracy{accuracy}); });
    return results;
}

py::array nearly_touching(const HeldBlob& self, const std::string& kind, const py::tuple& given, float accuracy,
                          unsigned threads) {
    return answer_shapes(
        {kind, given, origin_of(self.blob)}, nullptr, py::dtype::of<std::uint8_t>(),
        threads, [&](const auto& shape, std::size_t) requires requires { overlaps(self.blob, shape, Accuracy{}); } {
            return overlaps(self.blob, shape, Accuracy{accuracy});
        });
}

py::array bounds_of_distances(const HeldBlob& self, const py::handle& given, const py::handle& max_distance,
                              float accuracy, unsigned threads) {
    Floats points(given, "points", {3}, origin_of(self.blob));
    Floats distances(max_distance, "max_distance", {});
    const Batch batch({&points, &distances});
    const auto point = points.as<Vec3>();
    const auto distance = distances.as<float>();
    py::array results = batch.results(dtype_of("distance_bounds"));
    answer_each(
        static_cast<Result<DistanceBounds>*>(results.mutable_data()), batch.count(), threads,
        [&](std::size_t i) { return distance_bounds(self.blob, point.at(i), distance.at(i), Accuracy{accuracy}); });
    return results;
}

}  // namespace

void bind_approximations(py::module_& module) {
    module.def("nearly_occluded", nearly_occluded);
    module.def("nearly_touching", nearly_touching);
    module.def("distance_bounds", bounds_of_distances);
}

}  // namespace espalier::python
