// Deformable blobs: each pose is a blob of its own.
#include "bindings.hpp"
#include "held_blob.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>

#include <espalier/deformation.hpp>

namespace espalier::python {

namespace {

using Positions = py::array_t<float, py::array::c_style>;

/// Moves the vertices of a blob, whose bytes these are, and writes its checksum anew.
RefitResult refit_bytes(std::span<std::byte> bytes, std::span<const Vec3> positions) {
    const Blob blob = open(bytes);
    Deformable mesh = create_deformable(blob, bytes.first(deformable_bytes(blob)));
    RefitResult result;
    result.status = mesh.status();
    if (!mesh) return result;
    result = refit(mesh, positions);
    if (result) result.status = seal(mesh, bytes);
    return result;
}

/// Returns (blob, quality), or (status, position) of a refusal.
py::tuple refit_copy(const HeldBlob& self, const Positions& positions) {
    const std::span<const Vec3> given = {reinterpret_cast<const Vec3*>(positions.data()),
                                         static_cast<std::size_t>(positions.shape(0))};
    std::vector<std::byte> bytes;
    RefitResult result;
    {
        const py::gil_scoped_release unlocked;
        const auto source = self.bytes();
        bytes.assign(source.begin(), source.end());
        result = refit_bytes(bytes, given);
    }
    if (!result) return py::make_tuple(static_cast<int>(result.status), result.position);
    HeldBlob pose{HeldBytes::of(std::move(bytes)), {}};
    pose.blob = open(pose.held->bytes());
    return py::make_tuple(std::move(pose), result.quality);
}

}  // namespace

void bind_deformation(py::module_& module) { module.def("refit", refit_copy); }

}  // namespace espalier::python
