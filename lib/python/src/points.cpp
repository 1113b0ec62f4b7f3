// Closest points and triangles, inside and signed distance.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "shapes/batches.hpp"

#include <algorithm>

#include <espalier/batches/shapes.hpp>
#include <espalier/distance.hpp>

namespace espalier::python {

namespace {

/// Points, each with a distance.
struct Points {
    Floats points;
    Floats distances;
    Batch batch;
    Strided<Vec3> point;
    Strided<float> distance;

    Points(const py::handle& given_points, const py::handle& given_distances, const Origin& origin)
        : points(given_points, "points", {3}, origin),
          distances(given_distances, "max_distance", {}),
          batch({&points, &distances}),
          point(points.as<Vec3>()),
          distance(distances.as<float>()) {}
};

py::array closest_points(const HeldBlob& self, const py::handle& given, const py::handle& max_distance, bool is_signed,
                         unsigned threads) {
    const Points all(given, max_distance, origin_of(self.blob));
    py::array results = all.batch.results(dtype_of("closest_point"));
    const Blob& blob = self.blob;
    answer_each(static_cast<ClosestPoint*>(results.mutable_data()), all.batch.count(), threads, [&](std::size_t i) {
        return is_signed ? signed_distance(blob, all.point.at(i), all.distance.at(i))
                         : closest_point(blob, all.point.at(i), all.distance.at(i));
    });
    return results;
}

/// Returns the closest points to segments or boxes.
py::array closest_to_shapes(const HeldBlob& self, const std::string& kind, const py::tuple& given,
                            const py::handle& max_distance, unsigned threads) {
    Floats distances(max_distance, "max_distance", {});
    return answer_shapes(
        {kind, given, origin_of(self.blob)}, &distances, dtype_of("closest_point"),
        threads, [&](const auto& shape, std::size_t i) requires requires { closest_point(self.blob, shape, 0.0f); } {
            return closest_point(self.blob, shape, distances.as<float>().at(i));
        });
}

py::array inside(const HeldBlob& self, const py::handle& given, unsigned threads) {
    Floats points(given, "points", {3}, origin_of(self.blob));
    const Batch batch({&points});
    const auto point = points.as<Vec3>();
    py::array results = batch.results(py::dtype::of<std::uint8_t>());
    answer_each(static_cast<YesNo*>(results.mutable_data()), batch.count(), threads,
                [&](std::size_t i) { return contains(self.blob, point.at(i)); });
    return results;
}

py::array winding_numbers(const HeldBlob& self, const py::handle& given, unsigned directions, unsigned threads) {
    Floats points(given, "points", {3}, origin_of(self.blob));
    const Batch batch({&points});
    const auto point = points.as<Vec3>();
    py::array results = batch.results(dtype_of("winding"));
    answer_each(static_cast<Result<float>*>(results.mutable_data()), batch.count(), threads,
                [&](std::size_t i) { return winding_number(self.blob, point.at(i), directions); });
    return results;
}

/// Returns (offsets, nearest, statuses).
py::tuple closest_triangle_lists(const HeldBlob& self, const py::handle& given, const py::handle& max_distance,
                                 std::size_t most, unsigned threads) {
    const Points all(given, max_distance, origin_of(self.blob));
    most = std::min<std::size_t>(most, self.blob.triangle_count());
    return make_lists<ClosestPoint>(
        all.batch, dtype_of("closest_point"), threads, [&](std::size_t i, Growing<ClosestPoint>& nearest) {
            const Filled filled =
                closest_triangles(self.blob, all.point.at(i), nearest.places(most).first(most), all.distance.at(i));
            nearest.add(filled.count);
            return filled.status;
        });
}

}  // namespace

void bind_points(py::module_& module) {
    module.def("closest_points", closest_points);
    module.def("closest_to_shapes", closest_to_shapes);
    module.def("inside", inside);
    module.def("winding_numbers", winding_numbers);
    module.def("closest_triangle_lists", closest_triangle_lists);
}

}  // namespace espalier::python
