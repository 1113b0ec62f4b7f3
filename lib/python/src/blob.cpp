// Blobs: opening, facts, and their bytes.
#include "bindings.hpp"
#include "held_blob.hpp"

#include <string>
#include <tuple>

#include <pybind11/stl.h>

#include <espalier/bake.hpp>
#include <espalier/bounds.hpp>
#include <espalier/status.hpp>

namespace espalier::python {

namespace {

std::tuple<float, float, float> numbers(const Vec3& vector) { return {vector.x, vector.y, vector.z}; }

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
    py::dict facts;
    facts["triangle_count"] = blob.triangle_count();
    facts["duplicate_reference_count"] = blob.duplicate_reference_count();
    facts["vertex_count"] = blob.vertex_count();
    facts["size"] = blob.size();
    facts["checksum"] = blob.checksum();
    facts["depth"] = blob.depth();
    facts["profile"] = static_cast<int>(blob.profile());
    facts["max_error"] = blob.max_error();
    facts["bounds"] = py::make_tuple(numbers(bounds.min), numbers(bounds.max));
    facts["lattice_origin"] = numbers(lattice.origin);
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

}  // namespace

void bind_blob(py::module_& module) {
    py::class_<HeldBlob>(module, "Blob", py::buffer_protocol()).def("facts", facts_of).def_buffer([](HeldBlob& self) {
        const auto bytes = self.bytes();
        return py::buffer_info(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                               static_cast<py::ssize_t>(bytes.size()));
    });
    module.def("open", open_bytes);
    module.def("verify", [](const py::object& object) {
        const auto held = HeldBytes::of(object);
        const py::gil_scoped_release unlocked;
        return espalier::verify(held->bytes()).message;
    });
    module.def("describe_open", [](int status) { return describe(static_cast<OpenStatus>(status)); });
    module.def("describe_query", [](int status) { return describe(static_cast<QueryStatus>(status)); });
}

}  // namespace espalier::python
