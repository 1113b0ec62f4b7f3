// Arguments of one query of every kind about a scene, and a hash of what answers them.
#pragma once

#include "maker.hpp"
#include "platform/scene_answers.hpp"

namespace espalier::tests {

/// Arguments of one query of each kind.
struct SceneArguments {
    Ray ray;
    Vec3 point;
    float max_distance = infinity;
    float contact_distance = 0.0f;  ///< mostly small: contacts with a whole scene take a hundred times as long as a ray
    Sphere sphere;
    Capsule capsule;
    Box box;
    OrientedBox turned;
    Triangle triangle;
    Cone cone;
    Vec3 displacement;
    std::vector<Vec3> vertices;
    SceneSweepOptions options;

    /// Calls add(shape) with each shape whose overlaps a scene finds.
    template <class Add>
    void for_each_volume(const Add& add) const {
        add(sphere);
        add(capsule);
        add(box);
        add(turned);
        add(triangle);
        add(cone);
    }
    /// Calls add(shape) with each shape that sweeps take.
    template <class Add>
    void for_each_body(const Add& add) const {
        add(sphere);
        add(capsule);
        add(box);
        add(turned);
        add(ConvexHull{vertices});
    }
};

inline SceneArguments some_arguments(SceneQueryMaker& maker) {
    return {.ray = maker.ray(),
            .point = maker.point(),
            .max_distance = maker.sphere().radius,
            .contact_distance = maker.sphere().radius * (maker.random().below(16) == 0 ? 1.0f : 0x1p-6f),
            .sphere = maker.sphere(),
            .capsule = maker.capsule(),
            .box = maker.box(),
            .turned = maker.oriented_box(),
            .triangle = maker.triangle(),
            .cone = maker.cone(),
            .displacement = maker.displacement(),
            .vertices = maker.hull_vertices(),
            .options = maker.sweep_options({})};
}

/// Asks all of them. Returns a hash of every answer's bits.
inline std::uint64_t ask_everything(const BakedScene& scene, const SceneArguments& asked) {
    platform::Fingerprint all;
    platform::add_hit(all, raycast(scene, asked.ray));
    platform::add_answer(all, occluded(scene, asked.ray));
    const InScene<ClosestPoint> nearest = closest_point(scene, asked.point, asked.max_distance);
    platform::add_place(all, nearest);
    all.add(nearest->distance, nearest->u, nearest->v, nearest->point, nearest->face_normal, nearest->on_shape,
            static_cast<std::uint32_t>(nearest->feature), static_cast<std::uint32_t>(nearest->side));
    asked.for_each_body([&](const auto& body) {
        platform::add_hit(all, sweep(scene, body, asked.displacement, asked.options));
        if constexpr (!std::same_as<decltype(body), const Box&>) {
            InScene<Contact> contacts[8];
            Contact room[8];
            const Filled found = find_contacts(scene, body, asked.contact_distance, contacts, room);
            all.add(found.status);
            for (const InScene<Contact>& contact : found.in(contacts))
                all.add(contact.instance.index, contact.instance.in_tile, contact.hit.triangle.index,
                        contact.hit.distance, contact.hit.point, contact.hit.normal);
        }
    });
    all.add(for_each_hit(scene, asked.ray, [&](InstanceId instance, const RayHit& each) {
        platform::add_hit(all, InScene<RayHit>{each, instance});
        all.add(static_cast<std::uint32_t>(each.side));
    }));
    asked.for_each_volume([&](const auto& volume) {
        platform::add_answer(all, overlaps(scene, volume));
        all.add(for_each_overlap(scene, volume, [&](InstanceId instance, TriangleId triangle) {
            all.add(instance.index, instance.in_tile, triangle.index);
        }));
    });
    all.add(
        for_each_candidate(scene, asked.box, [&](InstanceId instance) { all.add(instance.index, instance.in_tile); }));
    return all.value();
}

}  // namespace espalier::tests
