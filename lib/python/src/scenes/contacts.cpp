// Contacts of bodies with all instances of a scene: those of find_contacts() for each instance near the body, in world
// space.
#include "bindings.hpp"
#include "dtypes.hpp"
#include "flags.hpp"
#include "lists.hpp"
#include "scenes/held_moving.hpp"
#include "shapes/batches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include <espalier/contact.hpp>
#include <espalier/scene.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/transform.hpp>

namespace espalier::python {

namespace {

/// A body in the local space of an instance. A hull has its vertices in memory of its own.
template <class Body>
struct Local {
    Body body;
    void move(const Transform& transform) { body = to_local(transform, body); }
    [[nodiscard]] const Body& get() const { return body; }
};
template <>
struct Local<ConvexHull> {
    std::vector<Vec3> vertices;
    explicit Local(const ConvexHull& hull) : vertices(hull.vertices.begin(), hull.vertices.end()) {}
    void move(const Transform& transform) {
        for (Vec3& vertex : vertices) vertex = to_local(transform, vertex);
    }
    [[nodiscard]] ConvexHull get() const { return {vertices}; }
};

/// Returns a box that holds a body, and whether queries take it.
template <class Body>
std::pair<Box, QueryStatus> box_around(const Body& body) {
    const detail::ShapeBounds bounds = detail::bounds_of(body);
    return {{translated(bounds.low, bounds.anchor), translated(bounds.high, bounds.anchor)}, bounds.status};
}
std::pair<Box, QueryStatus> box_around(const ConvexHull& hull) {
    if (hull.vertices.empty()) return {{}, QueryStatus::not_found};
    Box box = {hull.vertices[0], hull.vertices[0]};
    for (const Vec3& vertex : hull.vertices) {
        if (!(std::isfinite(vertex.x) && std::isfinite(vertex.y) && std::isfinite(vertex.z)))
            return {box, QueryStatus::invalid_argument};
        box.min = {std::min(box.min.x, vertex.x), std::min(box.min.y, vertex.y), std::min(box.min.z, vertex.z)};
        box.max = {std::max(box.max.x, vertex.x), std::max(box.max.y, vertex.y), std::max(box.max.z, vertex.z)};
    }
    return {box, QueryStatus::ok};
}

/// Widens a box on each side by a length, and by what the additions round.
Box widened(const Box& box, float by) {
    float most = by;
    for (const float coordinate : {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z})
        most = std::max(most, std::abs(coordinate));
    const float length = by + most * 0x1p-20f;
    return {translated(box.min, {-length, -length, -length}), translated(box.max, {length, length, length})};
}

/// An instance, its transform and, if it is one in a tile, first that of the tile.
struct Located {
    Blob mesh;
    std::vector<Transform> transforms;
};

Located locate(const BakedScene& scene, InstanceId instance) {
    Located found{mesh_at(scene, instance).value, {instance_at(scene, {instance.index}).value.transform}};
    if (instance.in_tile != no_instance.in_tile)
        found.transforms.push_back(instance_at(scene, instance).value.transform);
    return found;
}
Located locate(const MovingScene& scene, InstanceId instance) {
    const Instance outer = instance_at(scene, InstanceId{instance.index}).value;
    if (outer.mesh < scene.meshes().size()) return {scene.meshes()[outer.mesh], {outer.transform}};
    Located found = locate(scene.tiles()[outer.mesh - scene.meshes().size()], {instance.in_tile});
    found.transforms.insert(found.transforms.begin(), outer.transform);
    return found;
}

using SceneContact = InScene<Contact>;

/// Appends the contacts of a body with one instance, in world space.
template <class Body>
QueryStatus append_contacts(const Located& located, InstanceId instance, const Body& body, float margin,
                            std::size_t most, Growing<SceneContact>& all) {
    Local<Body> local{body};
    for (const Transform& transform : located.transforms) {
        local.move(transform);
        margin /= transform.scale;
    }
    std::vector<Contact> contacts(std::min<std::size_t>(most, std::size_t{8} * located.mesh.triangle_count()));
    const Filled filled = find_contacts(located.mesh, local.get(), margin, contacts);
    for (Contact contact : std::span(contacts).first(filled.count)) {
        for (auto transform = located.transforms.rbegin(); transform != located.transforms.rend(); ++transform) {
            contact.point = to_world(*transform, contact.point);
            contact.normal = normal_to_world(*transform, contact.normal);
            contact.distance *= transform->scale;
        }
        all.push({contact, instance});
    }
    return filled.status;
}

/// Appends the deepest contacts of a body with all instances; of equally deep ones those of the lowest instance and
/// triangle.
template <class Scene, class Body>
QueryStatus append_deepest(const Scene& scene, const Body& body, float margin, std::size_t most, const Flags& flags,
                           std::uint32_t mask, Growing<SceneContact>& all) {
    if (!(margin >= 0.0f) || std::isinf(margin)) return QueryStatus::invalid_argument;
    const auto [box, refusal] = box_around(body);
    if (is_refused(refusal)) return refusal;
    const Box around = widened(box, margin);
    Growing<InstanceId> near;
    QueryStatus status = append(near, [&](const auto& push) { return for_each_candidate(scene, around, push, mask); });
    const std::size_t before = all.count();
    bool is_full = false;
    for (const InstanceId instance : near.from(0)) {
        if (is_refused(status)) break;
        if (!flags(instance)) continue;
        status = append_contacts(locate(scene, instance), instance, body, margin, most, all);
        is_full |= status == QueryStatus::output_full;
    }
    if (is_refused(status)) {
        all.cut(before);
        return status;
    }
    const std::span<SceneContact> added = all.from(before);
    std::stable_sort(added.begin(), added.end(), [](const SceneContact& a, const SceneContact& b) {
        const auto key = [](const SceneContact& contact) {
            return std::tuple(contact.hit.distance, contact.instance.index, contact.instance.in_tile,
                              contact.hit.triangle.index);
        };
        return key(a) < key(b);
    });
    if (added.size() <= most) return is_full ? QueryStatus::output_full : QueryStatus::ok;
    all.cut(before + most);
    return QueryStatus::output_full;
}

/// Returns (offsets, contacts, statuses).
template <class Scene>
py::tuple contact_lists(const Scene& self, const std::string& kind, const py::tuple& given, const py::handle& margin,
                        std::size_t most, std::uint32_t mask, const py::object& only, unsigned threads) {
    Floats margins(margin, "margin", {});
    const Flags flags(only);
    return list_for_shapes<SceneContact>(
        {kind, given, origin_of(self)}, &margins, dtype_of("scene_contact"), threads,
        [&](const auto& body, std::size_t i, Growing<SceneContact>& contacts) requires requires {
            find_contacts(Blob(), body, 0.0f, std::span<Contact>());
        } { return append_deepest(self.scene, body, margins.as<float>().at(i), most, flags, mask, contacts); },
        reading(self));
}

}  // namespace

void bind_scene_contacts(py::module_& module) {
    module.def("scene_contact_lists", contact_lists<HeldScene>);
    module.def("scene_contact_lists", contact_lists<HeldMovingScene>);
}

}  // namespace espalier::python
