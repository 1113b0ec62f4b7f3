// Blobs: opening, facts, their bytes, and other poses of deformable ones.
#include "bindings.hpp"
#include "floats.hpp"
#include "held_blob.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <espalier/bake.hpp>
#include <espalier/bounds.hpp>
#include <espalier/deformation.hpp>
#include <espalier/status.hpp>

namespace espalier::python {

namespace {

/// Returns a place of a blob in the coordinates of the source.
std::array<double, 3> in_source(const Vec3& place, const Origin& origin) {
    const std::array<double, 3> numbers = {double(place.x), double(place.y), double(place.z)};
    if (!origin) return numbers;
    return {numbers[0] + origin->x, numbers[1] + origin->y, numbers[2] + origin->z};
}

/// Returns a blob, or the number of the refusal.
py::object open_bytes(const py::object& object) {
    HeldBlob opened{HeldBytes::of(object), {}};
    {
        const py::gil_scoped_release unlocked;
        opened.blob = open(opened.held->bytes());
    }
    if (!opened.blob) return py::int_(static_cast<int>(opened.blob.status()));
    return py::cast(std::move(opened));
}

py::dict facts_of(const HeldBlob& self) {
    const Blob& blob = self.blob;
    const Lattice lattice = blob.lattice();
    const Box bounds = blob.bounds();
    const Origin origin = origin_of(blob);
    const Vec3d from = blob.source_origin();
    py::dict facts;
    facts["triangle_count"] = blob.triangle_count();
    facts["duplicate_reference_count"] = blob.duplicate_reference_count();
    facts["vertex_count"] = blob.vertex_count();
    facts["size"] = blob.size();
    facts["checksum"] = blob.checksum();
    facts["depth"] = blob.depth();
    facts["profile"] = static_cast<int>(blob.profile());
    facts["max_error"] = blob.max_error();
    facts["bounds"] = py::make_tuple(py::tuple(py::cast(in_source(bounds.min, origin))),
                                     py::tuple(py::cast(in_source(bounds.max, origin))));
    facts["origin"] = py::make_tuple(from.x, from.y, from.z);
    facts["lattice_origin"] = py::tuple(py::cast(in_source(lattice.origin, origin)));
    facts["lattice_step_exponent"] = lattice.step_exponent;
    facts["lattice_extent"] = std::make_tuple(lattice.extent[0], lattice.extent[1], lattice.extent[2]);
    facts["is_closed"] = blob.is_closed();
    facts["is_deformable"] = blob.is_deformable();
    facts["has_original_ids"] = blob.has_original_ids();
    facts["has_materials"] = blob.has_materials();
    facts["has_edge_flags"] = blob.has_edge_flags();
    facts["is_view"] = self.held->is_view();
    return facts;
}

using Positions = py::array_t<float, py::array::c_style>;

/// Moves the vertices of a blob, whose bytes these are, and writes its checksum anew. Writes how many it has.
RefitResult refit_bytes(std::span<std::byte> bytes, std::span<const Vec3> positions, std::uint32_t& count) {
    const Blob blob = open(bytes);
    Deformable mesh = create_deformable(blob, bytes.first(deformable_bytes(blob)));
    count = mesh.position_count();
    RefitResult result;
    result.status = mesh.status();
    if (!mesh) return result;
    result = refit(mesh, positions);
    if (result) result.status = seal(mesh, bytes);
    return result;
}

/// Returns (blob, quality), or (status, position, number of positions that the blob takes) of a refusal.
py::tuple refit_copy(const HeldBlob& self, const Positions& positions) {
    const std::span<const Vec3> given = {reinterpret_cast<const Vec3*>(positions.data()),
                                         static_cast<std::size_t>(positions.shape(0))};
    std::vector<std::byte> bytes;
    RefitResult result;
    std::uint32_t count = 0;
    {
        const py::gil_scoped_release unlocked;
        const auto source = self.bytes();
        bytes.assign(source.begin(), source.end());
        result = refit_bytes(bytes, given, count);
    }
    if (!result) return py::make_tuple(static_cast<int>(result.status), result.position, count);
    HeldBlob pose{HeldBytes::of(std::move(bytes)), {}};
    {
        const py::gil_scoped_release unlocked;
        pose.blob = open(pose.held->bytes());
    }
    return py::make_tuple(std::move(pose), result.quality);
}

/// Returns (status, message), or the joined blobs.
py::object join(const py::list& blobs, const std::vector<std::array<float, 3>>& translations) {
    std::vector<std::vector<std::byte>> copies;
    for (const py::handle blob : blobs) {
        const auto bytes = blob.cast<const HeldBlob&>().bytes();
        copies.emplace_back(bytes.begin(), bytes.end());
    }
    JoinReport report;
    std::vector<HeldBlob> joined;
    {
        const py::gil_scoped_release unlocked;
        std::vector<JoinedBlob> given;
        for (std::size_t i = 0; i < copies.size(); ++i)
            given.push_back({copies[i], {translations[i][0], translations[i][1], translations[i][2]}});
        report = join_borders(given);
        for (auto& bytes : copies) {
            joined.push_back({HeldBytes::of(std::move(bytes)), {}});
            joined.back().blob = open(joined.back().held->bytes());
        }
    }
    if (!report) return py::make_tuple(static_cast<int>(report.status), report.message);
    return py::cast(std::move(joined));
}

}  // namespace

void bind_blob(py::module_& module) {
    py::class_<HeldBlob>(module, "Blob", py::buffer_protocol()).def("facts", facts_of).def_buffer([](HeldBlob& self) {
        const auto bytes = self.bytes();
        return py::buffer_info(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                               static_cast<py::ssize_t>(bytes.size()));
    });
    module.def("open", open_bytes);
    module.def("refit", refit_copy);
    module.def("join_borders", join);
    module.def("verify", [](const py::object& object) {
        const auto held = HeldBytes::of(object);
        const py::gil_scoped_release unlocked;
        return espalier::verify(held->bytes()).message;
    });
    module.def("describe_open", [](int status) { return describe(static_cast<OpenStatus>(status)); });
    module.def("describe_query", [](int status) { return describe(static_cast<QueryStatus>(status)); });
}

}  // namespace espalier::python
