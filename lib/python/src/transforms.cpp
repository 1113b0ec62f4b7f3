// Transforms as rows of eight numbers: a quaternion x, y, z, w, a translation and a scale.
#include "bindings.hpp"
#include "floats.hpp"

#include <algorithm>
#include <cstring>

#include <espalier/transform.hpp>

namespace espalier::python {

static_assert(sizeof(Transform) == 8 * sizeof(float));

namespace {

/// Returns (transforms, statuses) of matrices with at least three rows of four numbers.
py::tuple transforms_from_matrices(const py::handle& given) {
    Floats matrices(given, "matrix", {any, 4});
    if (matrices.element_axis(0) != 3 && matrices.element_axis(0) != 4)
        throw py::value_error("matrix must have the shape (..., 4, 4) or (..., 3, 4)");
    const Batch batch({&matrices});
    std::vector<py::ssize_t> shape = batch.shape();
    shape.push_back(8);
    py::array_t<float> transforms(shape);
    py::array statuses = batch.results(py::dtype::of<std::uint8_t>());
    auto* out = reinterpret_cast<char*>(transforms.mutable_data());
    auto* status = static_cast<QueryStatus*>(statuses.mutable_data());
    for (std::size_t i = 0; i < batch.count(); ++i) {
        float rows[3][4];
        std::memcpy(rows, matrices.at(i), sizeof rows);
        Result<Transform> result = transform_from_matrix(rows);
        // A transposed matrix has its translation there.
        constexpr float last_row[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        float fourth[4] = {0.0f, 0.0f, 0.0f, 1.0f};
        if (matrices.element_axis(0) == 4) std::memcpy(fourth, matrices.at(i) + sizeof rows, sizeof fourth);
        if (!std::equal(fourth, fourth + 4, last_row)) result = {{}, QueryStatus::invalid_argument};
        std::memcpy(out + i * sizeof(Transform), &result.value, sizeof(Transform));
        status[i] = result.status;
    }
    return py::make_tuple(transforms, statuses);
}

/// Calls move(transform, vector) for each query.
template <class Move>
py::array moved(const py::handle& transform, const py::handle& vector, const Move& move) {
    Floats transforms(transform, "transform", {8});
    Floats vectors(vector, "points", {3});
    const Batch batch({&transforms, &vectors});
    std::vector<py::ssize_t> shape = batch.shape();
    shape.push_back(3);
    py::array_t<float> results(shape);
    auto* out = reinterpret_cast<char*>(results.mutable_data());
    const auto from = transforms.as<Transform>();
    const auto given = vectors.as<Vec3>();
    {
        const py::gil_scoped_release unlocked;
        for (std::size_t i = 0; i < batch.count(); ++i) {
            const Vec3 result = move(from.at(i), given.at(i));
            std::memcpy(out + i * sizeof(Vec3), &result, sizeof result);
        }
    }
    return results;
}

}  // namespace

void bind_transforms(py::module_& module) {
    module.def("transforms_from_matrices", transforms_from_matrices);
    module.def("points_to_local", [](const py::handle& transform, const py::handle& points) {
        return moved(transform, points, [](const Transform& by, const Vec3& point) { return to_local(by, point); });
    });
    module.def("points_to_world", [](const py::handle& transform, const py::handle& points) {
        return moved(transform, points, [](const Transform& by, const Vec3& point) { return to_world(by, point); });
    });
    module.def("directions_to_local", [](const py::handle& transform, const py::handle& points) {
        return moved(transform, points,
                     [](const Transform& by, const Vec3& point) { return direction_to_local(by, point); });
    });
    module.def("normals_to_world", [](const py::handle& transform, const py::handle& normals) {
        return moved(transform, normals,
                     [](const Transform& by, const Vec3& normal) { return normal_to_world(by, normal); });
    });
    module.def("directions_to_world", [](const py::handle& transform, const py::handle& points) {
        return moved(transform, points,
                     [](const Transform& by, const Vec3& point) { return direction_to_world(by, point); });
    });
}

}  // namespace espalier::python
