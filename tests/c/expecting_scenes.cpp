#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

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

void Expecting::instance(InstanceId id) {
    const Result<Instance> result = instance_at(scene_, id);
    tell(result.status);
    tell(result->transform);
    for (const std::uint32_t number : {result->mesh, result->mask, result->user, result->source}) tell(number);
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

void Expecting::rays_in_scene(const SceneFilter& filter) {
    const std::array<Ray, 6> rays = made_rays<6>();
    for (const Ray& ray : rays) {
        tell(raycast(scene_, ray, filter));
        tell(occluded(scene_, ray, filter));
        visits_ = asked_.bits % 9;
        const auto visit = [&](InstanceId id, const RayHit& hit) {
            tell(id);
            tell(hit);
            return visit_one();
        };
        tell(for_each_hit(scene_, ray, visit, filter));
        const RoundedRay rounded = round_ray(scene_.common_lattice().value, ray);
        tell(raycast(scene_, ray, rounded, filter));
        tell(occluded(scene_, ray, rounded, filter));
        visits_ = asked_.bits % 9;
        tell(for_each_hit(scene_, ray, rounded, visit, filter));
    }
    std::array<InScene<RayHit>, 6> hits;
    hits.fill({RayHit{0, 0, 0, {}, {0}, QueryStatus::ok, Side::front}, {0, 0}});
    tell(raycast(scene_, rays, hits, filter));
    for (const InScene<RayHit>& hit : hits) tell(hit);
}

template <class Shape>
void Expecting::shape_in_scene(const Shape& shape, const SceneFilter& filter) {
    tell(overlaps(scene_, shape, filter));
    visits_ = asked_.bits % 9;
    const auto visit = [&](InstanceId id, TriangleId triangle) {
        tell(id);
        tell(triangle);
        return visit_one();
    };
    tell(for_each_overlap(scene_, shape, visit, filter));
}

void Expecting::shapes_in_scene(const SceneFilter& filter) {
    shape_in_scene(sphere(), filter);
    shape_in_scene(capsule(), filter);
    shape_in_scene(box(), filter);
    shape_in_scene(oriented_box(), filter);
    shape_in_scene(cone(), filter);
    shape_in_scene(triangle(), filter);
    tell(sweep(scene_, sphere(), direction(1), filter));
    tell(sweep(scene_, capsule(), direction(2), filter));
    tell(closest_point(scene_, point(3), length(3), filter.mask()));
    visits_ = asked_.bits % 5;
    const auto visit = [&](InstanceId id) {
        tell(id);
        return visit_one();
    };
    tell(for_each_candidate(scene_, box(), visit, filter.mask()));
}

void Expecting::scenes() {
    const auto keeps = [&](InstanceId id, TriangleId triangle) {
        return (id.index / 2 + id.in_tile + triangle.index + asked_.bits) % 2 == 0;
    };
    scene_itself();
    rays_in_scene({});
    rays_in_scene(asked_.bits % 16);
    rays_in_scene({asked_.bits >> 4, keeps});
    shapes_in_scene({});
    shapes_in_scene(asked_.bits % 16);
    shapes_in_scene({asked_.bits >> 4, keeps});
}

void Expecting::nothing_of_scenes() {
    for (int refused = 0; refused < 9; ++refused) tell(QueryStatus::invalid_argument);
    tell(raycast(scene_, std::span<const Ray>{}, std::span<InScene<RayHit>>{}));
}

}  // namespace espalier::tests
