#include "scene_loop.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include <espalier/advanced/rounding.hpp>
#include <espalier/scenes/contacts.hpp>

#include "support/base/same_bits.hpp"

namespace espalier::tests {

namespace scene_loops {  // with a name: what is instantiated elsewhere captures these

/// An instance, its blob, and the triangles of it that count.
struct InstanceInLoop {
    InstanceId id;
    Blob blob;
    Transform outer;         ///< that of the instance, or of the tile it is in
    const BakedScene* tile;  ///< null if it is in none
    Transform inner;         ///< within the tile
    const SceneFilter& filter;

    [[nodiscard]] bool keeps(TriangleId triangle) const { return !filter.keep() || filter.keep()(id, triangle); }

    /// Calls a function with the shape in the local space of the blob.
    template <class Shape, class Function>
    auto in_local(const Shape& shape, Function function) const {
        const auto local = to_local(outer, shape);
        return tile == nullptr ? function(local) : function(to_local(inner, local));
    }
    template <class Function>
    auto in_local(const ConvexHull& hull, Function function) const {
        std::vector<Vec3> vertices;
        for (const Vec3& vertex : hull.vertices) {
            const Vec3 local = to_local(outer, vertex);
            vertices.push_back(tile == nullptr ? local : to_local(inner, local));
        }
        return function(ConvexHull{vertices});
    }
    template <class Function>
    auto in_local(const Box& box, Function function) const {
        if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z)
            return function(box);  // empty in every space; it has no oriented form
        const OrientedBox local = to_local(outer, box);
        return tile == nullptr ? function(local) : function(to_local(inner, local));
    }
    [[nodiscard]] float length_in_local(float length) const {
        return in_local(Sphere{{}, length}, [](const Sphere& local) { return local.radius; });
    }
    [[nodiscard]] Vec3 direction_in_local(const Vec3& direction) const {
        const Vec3 local = direction_to_local(outer, direction);
        return tile == nullptr ? local : direction_to_local(inner, local);
    }
    [[nodiscard]] Vec3 in_world(const Vec3& point) const {
        return to_world(outer, tile == nullptr ? point : to_world(inner, point));
    }
    [[nodiscard]] Vec3 normal_in_world(const Vec3& normal) const {
        return normal_to_world(outer, tile == nullptr ? normal : normal_to_world(inner, normal));
    }
};

std::uint32_t end_of_numbers(const BakedScene& scene) { return scene.instance_count(); }
std::uint32_t end_of_numbers(const MovingScene& scene) { return scene.slot_end(); }

/// The loop, which counts the instances that refuse a query.
template <class Scene>
class SceneLoop {
public:
    SceneLoop(const Scene& scene, const SceneFilter& filter) : scene_(scene), filter_(filter) {}

    /// Calls `visit` with the instances that share a bit with the mask, in ascending order.
    template <class OnInstance>
    void for_each_instance(OnInstance visit) const {
        const std::size_t meshes = scene_.meshes().size();
        for (std::uint32_t i = 0; i < end_of_numbers(scene_); ++i) {
            const Result<Instance> found = instance_of_number(scene_, i);
            if (!found) continue;
            const Instance outer = *found;
            if ((outer.mask & filter_.mask()) == 0) continue;
            if (outer.mesh < meshes) {
                visit(InstanceInLoop{{i}, scene_.meshes()[outer.mesh], outer.transform, nullptr, {}, filter_});
                continue;
            }
            const BakedScene& tile = scene_.tiles()[outer.mesh - meshes];
            for (std::uint32_t j = 0; j < tile.instance_count(); ++j) {
                const Instance inner = *instance_at(tile, {j});
                if ((inner.mask & filter_.mask()) == 0) continue;
                visit(InstanceInLoop{
                    {i, j}, tile.meshes()[inner.mesh], outer.transform, &tile, inner.transform, filter_});
            }
        }
    }

    /// Returns the result with the least key; of equal ones the first. `query` returns that of an instance in its local
    /// space, and `to_world` moves it from there.
    template <class Hit, class Query, class ToWorld>
    InScene<Hit> best(float Hit::*key, Query query, ToWorld to_world) {
        InScene<Hit> best;
        best.hit.status = QueryStatus::not_found;
        for_each_instance([&](const InstanceInLoop& instance) {
            const Hit hit = query(instance);
            note(hit.status);
            if (hit && (!best || hit.*key < best.hit.*key)) best = {to_world(instance, hit), instance.id};
        });
        return best;
    }

    void note(QueryStatus status) { has_refusal_ |= is_refused(status); }
    /// Returns whether the scene refused what an instance refuses.
    [[nodiscard]] bool may_be_refused(QueryStatus status) const { return is_refused(status) && has_refusal_; }

private:
    const Scene& scene_;
    const SceneFilter& filter_;
    bool has_refusal_ = false;
};

struct Overlap {
    InstanceId instance;
    TriangleId triangle;
    friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// As everywhere in transforms, lengths below 2^-100 count as zero.
float zero_if_tiny(float length) { return std::abs(length) < 0x1p-100f ? 0.0f : length; }

}  // namespace scene_loops
using namespace scene_loops;

Result<Instance> instance_of_number(const BakedScene& scene, std::uint32_t number) {
    return instance_at(scene, InstanceId{number});
}
Result<Instance> instance_of_number(const MovingScene& scene, std::uint32_t number) {
    const Result<InstanceHandle> handle = handle_of(scene, number);
    return handle ? instance_at(scene, *handle) : Result<Instance>{{}, handle.status};
}

template <class Scene>
SceneComparison compare_rays(const Scene& scene, const Ray& ray, const SceneFilter& filter) {
    SceneLoop<Scene> loop(scene, filter);
    const RoundedRay rounded = round_ray(scene.common_lattice().value, ray);
    const auto cast = [&](const InstanceInLoop& instance) {
        const auto keep = [&](TriangleId triangle) { return instance.keeps(triangle); };
        const auto query = [&](const auto& local) { return raycast(instance.blob, local, keep); };
        if (is_on_common_lattice(scene, instance.id).yes()) return instance.in_local(rounded, query);
        // A tile that lies on no lattice with others rounds for its own instances.
        if (instance.tile != nullptr && !is_on_common_lattice(scene, {instance.id.index}).yes() &&
            is_on_common_lattice(*instance.tile, {instance.id.in_tile}).yes()) {
            const RoundedRay in_tile = round_ray(instance.tile->common_lattice().value, to_local(instance.outer, ray));
            return query(to_local(instance.inner, in_tile));
        }
        return instance.in_local(ray, query);
    };
    const auto move = [](const InstanceInLoop& instance, RayHit hit) {
        hit.normal = instance.normal_in_world(hit.normal);
        return hit;
    };
    const InScene<RayHit> expected = loop.best(&RayHit::t, cast, move);
    const InScene<RayHit> hit = raycast(scene, ray, filter);
    SceneComparison result;
    result.is_found = static_cast<bool>(hit);
    if (!loop.may_be_refused(hit->status) && !(same_bits(*hit, *expected) && hit.instance == expected.instance))
        result.fault = "the closest hit is another one than in the loop";
    const YesNo any = occluded(scene, ray, filter);
    if (!loop.may_be_refused(any.status()) && any != YesNo::of(static_cast<bool>(expected)))
        result.fault = "any hit differs from the loop";
    bool is_listed = !expected, is_sorted = true;
    InstanceId last = {0, 0};
    const auto see = [&](InstanceId instance, const RayHit& each) {
        is_sorted = is_sorted && instance >= last;
        last = instance;
        is_listed |= instance == expected.instance && same_bits(each, *expected);
    };
    const QueryStatus list = for_each_hit(scene, ray, see, filter);
    if (std::is_same_v<Scene, MovingScene>) is_sorted = true;
    if (!loop.may_be_refused(list) && !(list == QueryStatus::ok && is_listed && is_sorted))
        result.fault = "the list of hits lacks the closest one or is not sorted by instances";
    return result;
}
template SceneComparison compare_rays(const BakedScene&, const Ray&, const SceneFilter&);
template SceneComparison compare_rays(const MovingScene&, const Ray&, const SceneFilter&);

template <class Scene>
SceneComparison compare_closest_points(const Scene& scene, const Vec3& point, float max_distance, std::uint32_t mask) {
    const SceneFilter filter(mask);
    SceneLoop<Scene> loop(scene, filter);
    InScene<ClosestPoint> expected;
    expected.hit.status = QueryStatus::not_found;
    float least_in_tile = 0.0f;
    loop.for_each_instance([&](const InstanceInLoop& instance) {
        const float outer = instance.outer.scale, inner = instance.tile != nullptr ? instance.inner.scale : 1.0f;
        const auto smaller = [](float length, float scale) { return zero_if_tiny(zero_if_tiny(length) / scale); };
        const auto larger = [](float length, float scale) { return zero_if_tiny(zero_if_tiny(length) * scale); };
        ClosestPoint nearest = instance.in_local(point, [&](const Vec3& local) {
            return closest_point(instance.blob, local, smaller(smaller(max_distance, outer), inner));
        });
        loop.note(nearest.status);
        const float in_tile = larger(nearest.distance, inner);
        nearest.distance = larger(in_tile, outer);
        // A tile is queried as a mesh is: those in one tile are compared before the tile's scale rounds.
        const bool is_in_same_tile = expected.instance.index == instance.id.index;
        const bool is_nearer = is_in_same_tile ? in_tile < least_in_tile : nearest.distance < expected.hit.distance;
        if (!nearest || (expected && !is_nearer)) return;
        least_in_tile = in_tile;
        nearest.point = instance.in_world(nearest.point);
        nearest.on_shape = point;
        nearest.face_normal = instance.normal_in_world(nearest.face_normal);
        expected = {nearest, instance.id};
    });
    const InScene<ClosestPoint> nearest = closest_point(scene, point, max_distance, mask);
    SceneComparison result;
    result.is_found = static_cast<bool>(nearest);
    if (!loop.may_be_refused(nearest->status) &&
        !(same_bits(*nearest, *expected) && nearest.instance == expected.instance))
        result.fault = "the closest point is another one than in the loop";
    return result;
}
template SceneComparison compare_closest_points(const BakedScene&, const Vec3&, float, std::uint32_t);
template SceneComparison compare_closest_points(const MovingScene&, const Vec3&, float, std::uint32_t);

template <class Scene, class Shape>
SceneComparison compare_overlaps(const Scene& scene, const Shape& shape, const SceneFilter& filter) {
    SceneLoop<Scene> loop(scene, filter);
    std::vector<Overlap> expected, listed;
    loop.for_each_instance([&](const InstanceInLoop& instance) {
        const auto list = [&](TriangleId triangle) {
            if (instance.keeps(triangle)) expected.push_back({instance.id, triangle});
        };
        loop.note(
            instance.in_local(shape, [&](const auto& local) { return for_each_overlap(instance.blob, local, list); }));
    });
    const QueryStatus list = for_each_overlap(
        scene, shape,
        [&](InstanceId instance, TriangleId triangle) {
            listed.push_back({instance, triangle});
        },
        filter);
    // Those of one instance stay in order.
    if (std::is_same_v<Scene, MovingScene>) std::ranges::stable_sort(listed, {}, &Overlap::instance);
    SceneComparison result;
    result.is_found = !listed.empty();
    if (!loop.may_be_refused(list) && !(list == QueryStatus::ok && listed == expected))
        result.fault = "the list of overlaps differs from the loop";
    const YesNo any = overlaps(scene, shape, filter);
    if (!loop.may_be_refused(any.status()) && any != YesNo::of(!expected.empty()))
        result.fault = "whether anything overlaps differs from the loop";
    return result;
}
template SceneComparison compare_overlaps(const BakedScene&, const Sphere&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const Sphere&, const SceneFilter&);
template SceneComparison compare_overlaps(const BakedScene&, const Capsule&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const Capsule&, const SceneFilter&);
template SceneComparison compare_overlaps(const BakedScene&, const Box&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const Box&, const SceneFilter&);
template SceneComparison compare_overlaps(const BakedScene&, const OrientedBox&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const OrientedBox&, const SceneFilter&);
template SceneComparison compare_overlaps(const BakedScene&, const Triangle&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const Triangle&, const SceneFilter&);
template SceneComparison compare_overlaps(const BakedScene&, const Cone&, const SceneFilter&);
template SceneComparison compare_overlaps(const MovingScene&, const Cone&, const SceneFilter&);

template <class Scene, class Shape>
SceneComparison compare_sweeps(const Scene& scene, const Shape& shape, const Vec3& displacement,
                               const SceneSweepOptions& options) {
    SceneLoop<Scene> loop(scene, options.filter);
    InScene<SweepHit> expected;
    expected.hit.status = QueryStatus::not_found;
    expected.hit.t = 1.0f;
    float first = 2.0f;  // -1 at the start
    loop.for_each_instance([&](const InstanceInLoop& instance) {
        const auto keep = [&](TriangleId triangle) { return instance.keeps(triangle); };
        SweepOptions local = {keep, options.culling, options.ignore_leaving, instance.length_in_local(options.skin)};
        const auto sweep_with = [&](const SweepOptions& with) {
            return instance.in_local(shape, [&](const auto& moved) {
                return sweep(instance.blob, moved, instance.direction_in_local(displacement), with);
            });
        };
        SweepHit hit = sweep_with(local);
        loop.note(hit.status);
        if (!hit) return;
        // The first contact is that without a skin.
        local.skin = 0.0f;
        const float time = hit.starts_overlapping ? -1.0f : sweep_with(local).t;
        if (!(time < first)) return;
        first = time;
        hit.point = instance.in_world(hit.point);
        hit.normal = instance.normal_in_world(hit.normal);
        hit.face_normal = instance.normal_in_world(hit.face_normal);
        expected = {hit, instance.id};
    });
    const InScene<SweepHit> hit = sweep(scene, shape, displacement, options);
    SceneComparison result;
    result.is_found = static_cast<bool>(hit);
    if (!loop.may_be_refused(hit->status) && !(same_bits(*hit, *expected) && hit.instance == expected.instance))
        result.fault = "the first contact is another one than in the loop";
    return result;
}
template SceneComparison compare_sweeps(const BakedScene&, const Sphere&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const MovingScene&, const Sphere&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const BakedScene&, const Capsule&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const MovingScene&, const Capsule&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const BakedScene&, const Box&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const MovingScene&, const Box&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const BakedScene&, const OrientedBox&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const MovingScene&, const OrientedBox&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const BakedScene&, const ConvexHull&, const Vec3&, const SceneSweepOptions&);
template SceneComparison compare_sweeps(const MovingScene&, const ConvexHull&, const Vec3&, const SceneSweepOptions&);

template <class Scene, class Body>
SceneComparison compare_contacts(const Scene& scene, const Body& body, float margin, std::size_t places,
                                 const SceneFilter& filter) {
    SceneLoop<Scene> loop(scene, filter);
    std::vector<InScene<Contact>> expected, contacts(places);
    std::vector<Contact> room(places);
    bool is_cut = false;
    loop.for_each_instance([&](const InstanceInLoop& instance) {
        if (!instance.keeps(no_triangle)) return;
        const float reach = instance.length_in_local(margin);
        const Filled found = instance.in_local(
            body, [&](const auto& local) { return find_contacts(instance.blob, local, reach, room); });
        loop.note(found.status);
        is_cut |= found.status == QueryStatus::output_full;
        for (Contact contact : found.in(room)) {
            contact.point = instance.in_world(contact.point);
            contact.normal = instance.normal_in_world(contact.normal);
            for (const float scale : {instance.tile != nullptr ? instance.inner.scale : 1.0f, instance.outer.scale})
                contact.distance = zero_if_tiny(zero_if_tiny(contact.distance) * scale);
            expected.push_back({contact, instance.id});
        }
    });
    std::ranges::stable_sort(expected, {}, [](const auto& contact) { return contact.hit.distance; });
    is_cut |= expected.size() >= places && !expected.empty();
    if (is_cut) expected.resize(std::min(places, expected.size()));
    const Filled found = find_contacts(scene, body, margin, contacts, room, filter);
    SceneComparison result;
    result.is_found = found.count != 0;
    const auto is_same = [](const InScene<Contact>& a, const InScene<Contact>& b) {
        return same_bits(a.hit, b.hit) && a.instance == b.instance;
    };
    const std::span<InScene<Contact>> listed = found.in(contacts);
    if (!loop.may_be_refused(found.status) &&
        !(found.status == (is_cut ? QueryStatus::output_full : QueryStatus::ok) &&
          std::equal(listed.begin(), listed.end(), expected.begin(), expected.end(), is_same)))
        result.fault = "the contacts differ from the loop";
    return result;
}
template SceneComparison compare_contacts(const BakedScene&, const Sphere&, float, std::size_t, const SceneFilter&);
template SceneComparison compare_contacts(const MovingScene&, const Sphere&, float, std::size_t, const SceneFilter&);
template SceneComparison compare_contacts(const BakedScene&, const Capsule&, float, std::size_t, const SceneFilter&);
template SceneComparison compare_contacts(const MovingScene&, const Capsule&, float, std::size_t, const SceneFilter&);
template SceneComparison compare_contacts(const BakedScene&, const OrientedBox&, float, std::size_t,
                                          const SceneFilter&);
template SceneComparison compare_contacts(const MovingScene&, const OrientedBox&, float, std::size_t,
                                          const SceneFilter&);
template SceneComparison compare_contacts(const BakedScene&, const ConvexHull&, float, std::size_t, const SceneFilter&);
template SceneComparison compare_contacts(const MovingScene&, const ConvexHull&, float, std::size_t,
                                          const SceneFilter&);

}  // namespace espalier::tests
