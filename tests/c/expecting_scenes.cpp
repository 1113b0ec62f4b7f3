#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "expecting.hpp"

namespace espalier::tests {

template <class Hit>
void Expecting::tell(const InScene<Hit>& found) {
    tell(found.hit);
    tell(found.instance);
}

void Expecting::tell(InstanceId id) {
    tell(id.index);
    tell(id.in_tile);
}

void Expecting::tell(const Result<Instance>& instance) {
    tell(instance.status);
    tell(instance->transform);
    for (const std::uint32_t number : {instance->mesh, instance->mask, instance->user, instance->source}) tell(number);
}

void Expecting::instance(InstanceId id) {
    tell(instance_at(scene_, id));
    tell(is_on_common_lattice(scene_, id));
    const Result<Blob> mesh = mesh_at(scene_, id);
    tell(mesh.status);
    tell(mesh->checksum());
}

void Expecting::scene_itself() {
    tell(scene_.status());
    tell(scene_.instance_count());
    tell(scene_.size());
    tell(scene_.max_error());
    tell(scene_.bounds().min);
    tell(scene_.bounds().max);
    tell(std::uint64_t{scene_.meshes().size()});
    for (const Blob& mesh : scene_.meshes()) tell(mesh.checksum());
    tell(std::uint64_t{scene_.tiles().size()});
    for (const BakedScene& tile : scene_.tiles()) tell(tile.size());
    const Result<Lattice> common = scene_.common_lattice();
    tell(common.status);
    tell(common->origin);
    instance({asked_.bits % (scene_.instance_count() + 1)});
    instance({asked_.bits % (scene_.instance_count() + 1), asked_.bits % 4});
    instance({asked_.bits});
    instance(no_instance);
}

namespace {

/// The common lattice of a baked scene. Without one, that of the scene's first mesh.
template <class Scene>
Lattice region_of(const Scene& scene) {
    if constexpr (std::is_same_v<Scene, BakedScene>)
        if (scene.common_lattice()) return *scene.common_lattice();
    return scene.meshes().empty() ? Lattice() : scene.meshes()[0].lattice();
}

}  // namespace

template <class Scene>
void Expecting::rays_in(const Scene& scene, const SceneFilter& filter) {
    const std::array<Ray, 6> rays = made_rays<6>();
    for (const Ray& ray : rays) {
        tell(raycast(scene, ray, filter));
        tell(occluded(scene, ray, filter));
        visits_ = asked_.bits % 9;
        const auto visit = [&](InstanceId id, const RayHit& hit) {
            tell(id);
            tell(hit);
            return visit_one();
        };
        tell(for_each_hit(scene, ray, visit, filter));
        const RoundedRay rounded = round_ray(region_of(scene), ray);
        tell(raycast(scene, ray, rounded, filter));
        tell(occluded(scene, ray, rounded, filter));
        visits_ = asked_.bits % 9;
        tell(for_each_hit(scene, ray, rounded, visit, filter));
    }
    std::array<InScene<RayHit>, 6> hits;
    hits.fill({RayHit{0, 0, 0, {}, {0}, QueryStatus::ok, Side::front}, {0, 0}});
    tell(raycast(scene, rays, hits, filter));
    for (const InScene<RayHit>& hit : hits) tell(hit);
}

template <class Scene, class Shape>
void Expecting::shape_in(const Scene& scene, const Shape& shape, const SceneFilter& filter) {
    tell(overlaps(scene, shape, filter));
    visits_ = asked_.bits % 9;
    const auto visit = [&](InstanceId id, TriangleId triangle) {
        tell(id);
        tell(triangle);
        return visit_one();
    };
    tell(for_each_overlap(scene, shape, visit, filter));
}

template <class Scene, class Shape>
void Expecting::sweep_in(const Scene& scene, const Shape& shape, const SceneFilter& filter) {
    tell(sweep(scene, shape, direction(1), filter));
    SceneSweepOptions options;
    options.filter = filter;
    options.skin = asked_.lengths[1];
    options.culling = static_cast<FaceCulling>(asked_.bits & 3);
    options.ignore_leaving = (asked_.bits & 8) != 0;
    tell(sweep(scene, shape, direction(1), options));
}

template <class Scene>
void Expecting::shapes_in(const Scene& scene, const SceneFilter& filter) {
    shape_in(scene, sphere(), filter);
    shape_in(scene, capsule(), filter);
    shape_in(scene, box(), filter);
    shape_in(scene, oriented_box(), filter);
    shape_in(scene, cone(), filter);
    shape_in(scene, triangle(), filter);
    sweep_in(scene, sphere(), filter);
    sweep_in(scene, capsule(), filter);
    sweep_in(scene, box(), filter);
    sweep_in(scene, oriented_box(), filter);
    const std::array<Vec3, 4> vertices = all_points();
    sweep_in(scene, convex_hull(vertices), filter);
    tell(closest_point(scene, point(3), length(3), filter.mask()));
    visits_ = asked_.bits % 5;
    const auto visit = [&](InstanceId id) {
        tell(id);
        return visit_one();
    };
    tell(for_each_candidate(scene, box(), visit, filter.mask()));
}

void Expecting::scenes() {
    scene_itself();
    queries_of(scene_);
}

template <class Scene>
void Expecting::queries_of(const Scene& scene) {
    const auto keeps = [&](InstanceId id, TriangleId triangle) {
        return (id.index / 2 + id.in_tile + triangle.index + asked_.bits) % 2 == 0;
    };
    rays_in(scene, {});
    rays_in(scene, asked_.bits % 16);
    rays_in(scene, {asked_.bits >> 4, keeps});
    shapes_in(scene, {});
    shapes_in(scene, asked_.bits % 16);
    shapes_in(scene, {asked_.bits >> 4, keeps});
}

template void Expecting::queries_of(const BakedScene& scene);
template void Expecting::queries_of(const MovingScene& scene);

void Expecting::nothing_of_scenes() {
    for (int refused = 0; refused < 9; ++refused) tell(QueryStatus::invalid_argument);
    tell(raycast(scene_, std::span<const Ray>{}, std::span<InScene<RayHit>>{}));
}

}  // namespace espalier::tests
