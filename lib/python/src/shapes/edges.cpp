// How the surface bends at edges, and the normals of contacts there.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "held_blob.hpp"
#include "parts.hpp"

#include <cstring>

#include <pybind11/numpy.h>

#include <espalier/contact.hpp>

namespace espalier::python {

namespace {

using Ids = py::array_t<std::uint32_t, py::array::c_style>;
using Features = py::array_t<std::uint8_t, py::array::c_style>;

py::array kinds_of_edges(const HeldBlob& self, const Ids& triangles, unsigned threads) {
    py::array results(dtype_of("edge_kinds"), shape_of(triangles));
    const std::uint32_t* first = triangles.data();
    answer_each(static_cast<Result<EdgeKinds>*>(results.mutable_data()), static_cast<std::size_t>(triangles.size()),
                threads, [&](std::size_t i) { return edge_kinds(self.blob, TriangleId{first[i]}); });
    return results;
}

/// Triangles, features and normals have one shape.
py::array fixed_normals(const HeldBlob& self, const Ids& triangles, const Features& features, const py::handle& given,
                        unsigned threads) {
    Floats normals(given, "normals", {3});
    const Batch batch({&normals});
    if (static_cast<std::size_t>(triangles.size()) != batch.count() ||
        static_cast<std::size_t>(features.size()) != batch.count())
        throw py::value_error("there must be a triangle and a feature for each normal");
    std::vector<py::ssize_t> shape = batch.shape();
    shape.push_back(3);
    py::array_t<float> results(shape);
    auto* out = reinterpret_cast<char*>(results.mutable_data());
    const std::uint32_t* triangle = triangles.data();
    const std::uint8_t* feature = features.data();
    const auto normal = normals.as<Vec3>();
    run_ranges(batch.count(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 fixed = fix_internal_edge_normal(self.blob, TriangleId{triangle[i]},
                                                        static_cast<Feature>(feature[i]), normal.at(i));
            std::memcpy(out + i * sizeof fixed, &fixed, sizeof fixed);
        }
    });
    return results;
}

}  // namespace

void bind_edges(py::module_& module) {
    module.def("edge_kinds", kinds_of_edges);
    module.def("fixed_normals", fixed_normals);
}

}  // namespace espalier::python
