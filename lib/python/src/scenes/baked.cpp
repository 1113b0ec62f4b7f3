// Baked scenes: many instances of blobs in one file.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "held_blob.hpp"
#include "scenes/instances.hpp"

#include <array>
#include <cstring>
#include <optional>

#include <pybind11/stl.h>

#include <espalier/scenes/bake.hpp>

namespace espalier::python {

namespace {

/// Returns an open scene, or the number of the refusal.
py::object open_held(std::shared_ptr<const HeldBytes> held) {
    auto opened = std::make_unique<HeldScene>();
    opened->held = std::move(held);
    {
        const py::gil_scoped_release unlocked;
        const auto bytes = opened->held->bytes();
        opened->meshes.resize(mesh_count_of_scene(bytes));
        opened->tiles.resize(tile_count_of_scene(bytes));
        opened->scene = open_scene(bytes, opened->meshes, opened->tiles);
    }
    if (!opened->scene) return py::int_(static_cast<int>(opened->scene.status()));
    return py::cast(std::move(opened));
}

/// Returns (status, message), or an open scene and the messages of its warnings. `places` has 8 numbers, `numbers`
/// mesh, mask and user of each instance. `translations` are those of `places` where float32 may not hold them, else
/// None; `origin` has three numbers, or is None where the baker chooses it.
py::object bake(const py::list& blobs, const py::handle& places, const GivenInstances::Numbers& numbers,
                const py::object& translations, const py::object& origin) {
    const GivenInstances given(places, numbers);
    std::vector<Vec3d> wide;
    if (!translations.is_none()) {
        const py::array_t<double, py::array::c_style | py::array::forcecast> rows(translations);
        wide.resize(static_cast<std::size_t>(rows.size()) / 3);
        if (!wide.empty()) std::memcpy(static_cast<void*>(wide.data()), rows.data(), wide.size() * sizeof(Vec3d));
    }
    SceneBakeOptions options = {wide, std::nullopt};
    if (!origin.is_none()) {
        const auto [x, y, z] = origin.cast<std::array<double, 3>>();
        options.origin = Vec3d{x, y, z};
    }
    std::vector<std::shared_ptr<const HeldBytes>> held;
    std::vector<std::span<const std::byte>> bytes;
    for (const py::handle blob : blobs) {
        if (py::isinstance<HeldBlob>(blob)) {
            bytes.push_back(blob.cast<const HeldBlob&>().bytes());
        } else if (py::isinstance<HeldScene>(blob)) {
            bytes.push_back(blob.cast<const HeldScene&>().held->bytes());
        } else {
            held.push_back(HeldBytes::of(blob));
            bytes.push_back(held.back()->bytes());
        }
    }
    std::vector<Instance> instances;
    for (std::size_t i = 0; i < given.batch.count(); ++i) instances.push_back(given.at(i));
    SceneBakeResult result;
    {
        const py::gil_scoped_release unlocked;
        result = bake_scene(bytes, instances, options);
    }
    if (!result) return py::make_tuple(static_cast<int>(result.status), result.message);
    py::list warnings;
    for (const BakeWarning& warning : result.report.warnings) warnings.append(warning.message);
    return py::make_tuple(open_held(HeldBytes::of(std::move(result.bytes))), warnings);
}

py::array instances_of(const HeldScene& self) {
    py::array results(dtype_of("instance"),
                      std::vector<py::ssize_t>{static_cast<py::ssize_t>(self.scene.instance_count())});
    auto* out = static_cast<char*>(results.mutable_data());
    for (std::uint32_t i = 0; i < self.scene.instance_count(); ++i) {
        const Instance instance = instance_at(self.scene, {i, InstanceId{}.in_tile}).value;
        std::memcpy(out + i * sizeof instance, &instance, sizeof instance);
    }
    return results;
}

/// Returns one of the scene's meshes, which lie in the bytes of the scene.
HeldBlob mesh_of(const HeldScene& self, std::size_t mesh) {
    if (mesh >= self.scene.meshes().size()) throw py::index_error("the scene has no such mesh");
    return {self.held, self.scene.meshes()[mesh]};
}

py::array on_common_lattice(const HeldScene& self) {
    py::array_t<bool> results(static_cast<py::ssize_t>(self.scene.instance_count()));
    for (std::uint32_t i = 0; i < self.scene.instance_count(); ++i)
        results.mutable_data()[i] = is_on_common_lattice(self.scene, {i}).yes();
    return results;
}

}  // namespace

void bind_baked_scenes(py::module_& module) {
    py::class_<HeldScene>(module, "Scene", py::buffer_protocol())
        .def("instances", instances_of)
        .def("mesh", mesh_of)
        .def("on_common_lattice", on_common_lattice)
        .def("facts",
             [](const HeldScene& self) {
                 const Box bounds = self.scene.bounds();
                 const Vec3d origin = self.scene.source_origin();
                 const auto in_source = [&](const Vec3& corner) {
                     return py::make_tuple(double(corner.x) + origin.x, double(corner.y) + origin.y,
                                           double(corner.z) + origin.z);
                 };
                 py::dict facts;
                 facts["instance_count"] = self.scene.instance_count();
                 facts["mesh_count"] = self.scene.meshes().size();
                 facts["tile_count"] = self.scene.tiles().size();
                 facts["size"] = self.scene.size();
                 facts["max_error"] = self.scene.max_error();
                 facts["origin"] = py::make_tuple(origin.x, origin.y, origin.z);
                 facts["bounds"] = py::make_tuple(in_source(bounds.min), in_source(bounds.max));
                 return facts;
             })
        .def_buffer([](HeldScene& self) {
            const auto bytes = self.held->bytes();
            return py::buffer_info(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                   static_cast<py::ssize_t>(bytes.size()));
        });
    module.def("open_scene", [](const py::object& object) { return open_held(HeldBytes::of(object)); });
    module.def("bake_scene", bake);
    module.def("verify_scene", [](const py::object& object) {
        const auto held = HeldBytes::of(object);
        const py::gil_scoped_release unlocked;
        return verify_scene(held->bytes()).message;
    });
}

}  // namespace espalier::python
