// Queries of scenes: those of baked and of moving ones are the same.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "flags.hpp"
#include "floats.hpp"
#include "lists.hpp"
#include "parts.hpp"
#include "rays.hpp"
#include "scenes/held_moving.hpp"
#include "shapes/batches.hpp"
#include "shapes/sweeps.hpp"

#include <algorithm>
#include <type_traits>

#include <espalier/scene.hpp>
#include <espalier/scenes/moving_scene.hpp>

namespace espalier::python {

namespace {

/// A triangle of an instance, as the type scene_triangle has it.
struct SceneTriangle {
    InstanceId instance;
    TriangleId triangle;
};
static_assert(sizeof(SceneTriangle) == 12);

/// The four arguments of rays, and the flags of the instances that they may hit.
struct FilteredRays : Rays {
    Flags flags;

    FilteredRays(const py::tuple& given, int culling, const py::object& only, const Origin& origin)
        : Rays{given[0], given[1], given[2], given[3], culling, origin}, flags(only) {}
};

template <class Scene>
py::array raycasts(const Scene& self, const py::tuple& given, int culling, std::uint32_t mask, const py::object& only,
                   unsigned threads) {
    const FilteredRays rays(given, culling, only, origin_of(self));
    py::array results = rays.batch.results(dtype_of("scene_ray_hit"));
    answer_each(
        static_cast<InScene<RayHit>*>(results.mutable_data()), rays.batch.count(), threads,
        [&](std::size_t i) { return raycast(self.scene, rays.arrays.at(i), rays.flags.of_instances(mask)); },
        reading(self));
    return results;
}

template <class Scene>
py::array occlusions(const Scene& self, const py::tuple& given, int culling, std::uint32_t mask, const py::object& only,
                     unsigned threads) {
    const FilteredRays rays(given, culling, only, origin_of(self));
    py::array results = rays.batch.results(py::dtype::of<std::uint8_t>());
    answer_each(
        static_cast<YesNo*>(results.mutable_data()), rays.batch.count(), threads,
        [&](std::size_t i) { return occluded(self.scene, rays.arrays.at(i), rays.flags.of_instances(mask)); },
        reading(self));
    return results;
}

/// Appends what walk(visit) visits, in ascending order of instances, and returns its status. A moving scene visits in
/// the order of its tree, but within one instance in that of a baked scene. Nothing of a refused query is kept there.
template <class Scene, class Value, class Walk>
QueryStatus append_by_instance(Growing<Value>& all, const Walk& walk) {
    const std::size_t before = all.count();
    const QueryStatus status = append(all, walk);
    if constexpr (std::is_same_v<Scene, HeldMovingScene>) {
        if (is_refused(status)) all.cut(before);  // what was visited until then depends on the tree
        const std::span<Value> added = all.from(before);
        std::stable_sort(added.begin(), added.end(),
                         [](const Value& a, const Value& b) { return a.instance.index < b.instance.index; });
    }
    return status;
}

template <class Scene>
py::tuple hit_lists(const Scene& self, const py::tuple& given, int culling, std::uint32_t mask, const py::object& only,
                    unsigned threads) {
    const FilteredRays rays(given, culling, only, origin_of(self));
    using Hit = InScene<RayHit>;
    return make_lists<Hit>(
        rays.batch, dtype_of("scene_ray_hit"), threads,
        [&](std::size_t i, Growing<Hit>& hits) {
            return append_by_instance<Scene>(hits, [&](const auto& push) {
                return for_each_hit(
                    self.scene, rays.arrays.at(i),
                    [&](InstanceId instance, const RayHit& hit) {
                        return push(Hit{hit, instance});
                    },
                    rays.flags.of_instances(mask));
            });
        },
        reading(self));
}

template <class Scene>
py::array closest_points(const Scene& self, const py::handle& given, const py::handle& max_distance, std::uint32_t mask,
                         unsigned threads) {
    Floats points(given, "points", {3}, origin_of(self));
    Floats distances(max_distance, "max_distance", {});
    const Batch batch({&points, &distances});
    const auto point = points.as<Vec3>();
    const auto distance = distances.as<float>();
    py::array results = batch.results(dtype_of("scene_closest_point"));
    answer_each(
        static_cast<InScene<ClosestPoint>*>(results.mutable_data()), batch.count(), threads,
        [&](std::size_t i) { return closest_point(self.scene, point.at(i), distance.at(i), mask); }, reading(self));
    return results;
}

template <class Scene>
py::array sweeps(const Scene& self, const std::string& kind, const py::tuple& given, const py::handle& displacement,
                 const GivenSweepOptions& given_options, std::uint32_t mask, const py::object& only, unsigned threads) {
    const Flags flags(only);
    auto options = sweep_options<SceneSweepOptions>(given_options);
    options.filter = flags.of_instances(mask);
    Floats ways(displacement, "displacement", {3});
    const auto answer = [&](const auto& shape, std::size_t i) requires requires {
        sweep(self.scene, shape, Vec3{}, SceneFilter());
    }
    { return sweep(self.scene, shape, ways.as<Vec3>().at(i), options); };
    return answer_shapes({kind, given, origin_of(self)}, &ways, dtype_of("scene_sweep_hit"), threads, answer,
                         reading(self));
}

template <class Scene>
py::array touching(const Scene& self, const std::string& kind, const py::tuple& given, std::uint32_t mask,
                   const py::object& only, unsigned threads) {
    const Flags flags(only);
    const auto answer = [&](const SceneShape auto& shape, std::size_t) {
        return overlaps(self.scene, shape, flags.of_instances(mask));
    };
    return answer_shapes({kind, given, origin_of(self)}, nullptr, py::dtype::of<std::uint8_t>(), threads, answer,
                         reading(self));
}

template <class Scene>
py::tuple touching_lists(const Scene& self, const std::string& kind, const py::tuple& given, std::uint32_t mask,
                         const py::object& only, unsigned threads) {
    const Flags flags(only);
    const auto list = [&](const SceneShape auto& shape, std::size_t, Growing<SceneTriangle>& triangles) {
        return append_by_instance<Scene>(triangles, [&](const auto& push) {
            return for_each_overlap(
                self.scene, shape,
                [&](InstanceId instance, TriangleId triangle) {
                    return push(SceneTriangle{instance, triangle});
                },
                flags.of_instances(mask));
        });
    };
    return list_for_shapes<SceneTriangle>({kind, given, origin_of(self)}, nullptr, dtype_of("scene_triangle"), threads,
                                          list, reading(self));
}

/// Returns (offsets, ids, statuses) of the instances whose boxes in the tree touch each box.
template <class Scene>
py::tuple candidate_lists(const Scene& self, const py::tuple& given, std::uint32_t mask, unsigned threads) {
    return list_for_shapes<InstanceId>(
        {"Box", given, origin_of(self)}, nullptr, dtype_of("candidate"), threads,
        [&](const auto& box, std::size_t, Growing<InstanceId>& instances) requires requires {
            for_each_candidate(
                self.scene, box, [](InstanceId) { return Visit::next; }, mask);
        } {
            const std::size_t before = instances.count();
            const QueryStatus status =
                append(instances, [&](const auto& push) { return for_each_candidate(self.scene, box, push, mask); });
            if (is_refused(status)) instances.cut(before);
            const std::span<InstanceId> added = instances.from(before);
            std::stable_sort(added.begin(), added.end(), [](InstanceId a, InstanceId b) { return a.index < b.index; });
            return status;
        },
        reading(self));
}

template <class Scene>
void bind_queries_of(py::module_& module) {
    module.def("scene_raycasts", raycasts<Scene>);
    module.def("scene_occlusions", occlusions<Scene>);
    module.def("scene_hit_lists", hit_lists<Scene>);
    module.def("scene_closest_points", closest_points<Scene>);
    module.def("scene_sweeps", sweeps<Scene>);
    module.def("scene_candidate_lists", candidate_lists<Scene>);
    module.def("scene_touching", touching<Scene>);
    module.def("scene_touching_lists", touching_lists<Scene>);
}

}  // namespace

void bind_scene_queries(py::module_& module) {
    bind_queries_of<HeldScene>(module);
    bind_queries_of<HeldMovingScene>(module);
}

}  // namespace espalier::python
