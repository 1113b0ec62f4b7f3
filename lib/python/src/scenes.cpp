// Scenes: many instances of blobs.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "floats.hpp"
#include "held_blob.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "rays.hpp"
#include "shape_batches.hpp"
#include "sweeps.hpp"

#include <cstring>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>

namespace espalier::python {

namespace {

/// A triangle of an instance, as the type scene_triangle has it.
struct SceneTriangle {
    InstanceId instance;
    TriangleId triangle;
};
static_assert(sizeof(SceneTriangle) == 12);

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

/// Returns (status, message), or an open scene. `places` has 8 numbers, `numbers` mesh, mask and user of each instance.
py::object bake(const py::list& blobs, const py::handle& places,
                const py::array_t<std::uint32_t, py::array::c_style>& numbers) {
    Floats transforms(places, "places", {8});
    const Batch batch({&transforms});
    if (numbers.ndim() != 2 || numbers.shape(1) != 3 || static_cast<std::size_t>(numbers.shape(0)) != batch.count())
        throw py::value_error("there must be a mesh, a mask and a user's number for each instance");
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
    std::vector<Instance> instances(batch.count());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const std::uint32_t* row = numbers.data() + 3 * i;
        instances[i] = {transforms.as<Transform>().at(i), row[0], row[1], row[2], 0};
    }
    SceneBakeResult result;
    {
        const py::gil_scoped_release unlocked;
        result = bake_scene(bytes, instances);
    }
    if (!result) return py::make_tuple(static_cast<int>(result.status), result.message);
    return open_held(HeldBytes::of(std::move(result.bytes)));
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

/// Takes the four arguments of rays.
Rays rays_of(const py::tuple& given, int culling) { return {given[0], given[1], given[2], given[3], culling}; }

py::array raycasts(const HeldScene& self, const py::tuple& given, int culling, std::uint32_t mask, unsigned threads) {
    const Rays rays = rays_of(given, culling);
    py::array results = rays.batch.results(dtype_of("scene_ray_hit"));
    answer_each(static_cast<InScene<RayHit>*>(results.mutable_data()), rays.batch.count(), threads,
                [&](std::size_t i) { return raycast(self.scene, rays.arrays.at(i), SceneFilter(mask)); });
    return results;
}

py::array occlusions(const HeldScene& self, const py::tuple& given, int culling, std::uint32_t mask, unsigned threads) {
    const Rays rays = rays_of(given, culling);
    py::array results = rays.batch.results(py::dtype::of<std::uint8_t>());
    answer_each(static_cast<YesNo*>(results.mutable_data()), rays.batch.count(), threads,
                [&](std::size_t i) { return occluded(self.scene, rays.arrays.at(i), SceneFilter(mask)); });
    return results;
}

py::tuple hit_lists(const HeldScene& self, const py::tuple& given, int culling, std::uint32_t mask, unsigned threads) {
    const Rays rays = rays_of(given, culling);
    using Hit = InScene<RayHit>;
    return make_lists<Hit>(rays.batch, dtype_of("scene_ray_hit"), threads, [&](std::size_t i, Growing<Hit>& hits) {
        return append(hits, [&](const auto& push) {
            return for_each_hit(
                self.scene, rays.arrays.at(i),
                [&](InstanceId instance, const RayHit& hit) {
                    return push(Hit{hit, instance});
                },
                SceneFilter(mask));
        });
    });
}

py::array closest_points(const HeldScene& self, const py::handle& given, const py::handle& max_distance,
                         std::uint32_t mask, unsigned threads) {
    Floats points(given, "points", {3});
    Floats distances(max_distance, "max_distance", {});
    const Batch batch({&points, &distances});
    const auto point = points.as<Vec3>();
    const auto distance = distances.as<float>();
    py::array results = batch.results(dtype_of("scene_closest_point"));
    answer_each(static_cast<InScene<ClosestPoint>*>(results.mutable_data()), batch.count(), threads,
                [&](std::size_t i) { return closest_point(self.scene, point.at(i), distance.at(i), mask); });
    return results;
}

py::array sweeps(const HeldScene& self, const std::string& kind, const py::tuple& given, const py::handle& displacement,
                 const GivenSweepOptions& given_options, std::uint32_t mask, unsigned threads) {
    auto options = sweep_options<SceneSweepOptions>(given_options);
    options.filter = SceneFilter(mask);
    Floats ways(displacement, "displacement", {3});
    return answer_shapes(
        kind, given, &ways, dtype_of("scene_sweep_hit"), threads,
        [&](const auto& shape, std::size_t i) requires requires { sweep(self.scene, shape, Vec3{}, SceneFilter()); } {
            return sweep(self.scene, shape, ways.as<Vec3>().at(i), options);
        });
}

py::array touching(const HeldScene& self, const std::string& kind, const py::tuple& given, std::uint32_t mask,
                   unsigned threads) {
    return answer_shapes(
        kind, given, nullptr, py::dtype::of<std::uint8_t>(), threads,
        [&](const SceneShape auto& shape, std::size_t) { return overlaps(self.scene, shape, SceneFilter(mask)); });
}

py::tuple touching_lists(const HeldScene& self, const std::string& kind, const py::tuple& given, std::uint32_t mask,
                         unsigned threads) {
    return list_for_shapes<SceneTriangle>(
        kind, given, nullptr, dtype_of("scene_triangle"), threads,
        [&](const SceneShape auto& shape, std::size_t, Growing<SceneTriangle>& triangles) {
            return append(triangles, [&](const auto& push) {
                return for_each_overlap(
                    self.scene, shape,
                    [&](InstanceId instance, TriangleId triangle) {
                        return push(SceneTriangle{instance, triangle});
                    },
                    SceneFilter(mask));
            });
        });
}

/// Returns one of the scene's meshes, which lie in the bytes of the scene.
HeldBlob mesh_of(const HeldScene& self, std::size_t mesh) {
    if (mesh >= self.scene.meshes().size()) throw py::index_error("the scene has no such mesh");
    return {self.held, self.scene.meshes()[mesh]};
}

}  // namespace

void bind_scenes(py::module_& module) {
    py::class_<HeldScene>(module, "Scene", py::buffer_protocol())
        .def("instances", instances_of)
        .def("mesh", mesh_of)
        .def("facts",
             [](const HeldScene& self) {
                 const Box bounds = self.scene.bounds();
                 py::dict facts;
                 facts["instance_count"] = self.scene.instance_count();
                 facts["mesh_count"] = self.scene.meshes().size();
                 facts["tile_count"] = self.scene.tiles().size();
                 facts["size"] = self.scene.size();
                 facts["max_error"] = self.scene.max_error();
                 facts["bounds"] = py::make_tuple(py::make_tuple(bounds.min.x, bounds.min.y, bounds.min.z),
                                                  py::make_tuple(bounds.max.x, bounds.max.y, bounds.max.z));
                 return facts;
             })
        .def_buffer([](HeldScene& self) {
            const auto bytes = self.held->bytes();
            return py::buffer_info(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                   static_cast<py::ssize_t>(bytes.size()));
        });
    module.def("open_scene", [](const py::object& object) { return open_held(HeldBytes::of(object)); });
    module.def("bake_scene", bake);
    module.def("scene_raycasts", raycasts);
    module.def("scene_occlusions", occlusions);
    module.def("scene_hit_lists", hit_lists);
    module.def("scene_closest_points", closest_points);
    module.def("scene_sweeps", sweeps);
    module.def("scene_touching", touching);
    module.def("scene_touching_lists", touching_lists);
}

}  // namespace espalier::python
