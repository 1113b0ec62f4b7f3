// Queries of a scene.
#include "questions.hpp"
#include "words.hpp"

#include <espalier/scene.hpp>

namespace {

constexpr std::uint32_t mask = 2;

template <class Hit>
void add(Words& words, const espalier::InScene<Hit>& found) {
    add(words, found.hit);
    words.add(found.instance);
}

void answer_facts(const espalier::BakedScene& scene) {
    Words facts("scene_facts");
    facts.add(scene.instance_count(), scene.meshes().size(), scene.max_error(), scene.bounds().min, scene.bounds().max);
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const espalier::Instance instance = espalier::instance_at(scene, {i, espalier::no_instance.in_tile}).value;
        const espalier::Quaternion& rotation = instance.transform.rotation;
        facts.add(rotation.x, rotation.y, rotation.z, rotation.w, instance.transform.translation,
                  instance.transform.scale, instance.mesh, instance.mask, instance.user, instance.source);
    }
}

void answer_rays(const espalier::BakedScene& scene, const Questions& questions) {
    Words closest("scene_raycast");
    Words any("scene_occluded");
    Words all("scene_all_hits");
    Words nearest("scene_closest_point");
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        espalier::Ray ray = questions.ray(i);
        ray.culling = espalier::FaceCulling::back;
        add(closest, espalier::raycast(scene, ray, mask));
        any.add(espalier::occluded(scene, ray, mask).status());
        all.add(espalier::for_each_hit(
            scene, ray,
            [&](espalier::InstanceId instance, const espalier::RayHit& hit) {
                add(all, hit);
                all.add(instance);
            },
            mask));
        add(nearest, espalier::closest_point(scene, questions.origins[i], 2.5f, mask));
    }
}

template <class Shape>
void answer_volume(const espalier::BakedScene& scene, const Shape& shape, Words& words) {
    words.add(espalier::overlaps(scene, shape, mask).status());
    words.add(espalier::for_each_overlap(
        scene, shape,
        [&](espalier::InstanceId instance, espalier::TriangleId triangle) { words.add(instance, triangle); }, mask));
}

template <class Shape>
void answer_sweep(const espalier::BakedScene& scene, const Shape& shape, espalier::Vec3 displacement, Words& words) {
    espalier::SceneSweepOptions options;
    options.filter = mask;
    options.culling = espalier::FaceCulling::back;
    options.ignore_leaving = true;
    options.skin = 0.01f;
    add(words, espalier::sweep(scene, shape, displacement, options));
}

void answer_shapes(const espalier::BakedScene& scene, const Questions& questions) {
    Words touching[] = {Words("scene_sphere"),       Words("scene_capsule"), Words("scene_box"),
                        Words("scene_oriented_box"), Words("scene_cone"),    Words("scene_triangle")};
    Words sweeps[] = {Words("scene_sweep_sphere"), Words("scene_sweep_capsule"), Words("scene_sweep_box"),
                      Words("scene_sweep_oriented_box"), Words("scene_sweep_convex_hull")};
    for (std::size_t i = 0; i < questions.origins.size(); ++i) {
        const Shapes shapes = questions.shapes(i);
        answer_volume(scene, shapes.sphere, touching[0]);
        answer_volume(scene, shapes.capsule, touching[1]);
        answer_volume(scene, shapes.box, touching[2]);
        answer_volume(scene, shapes.oriented_box, touching[3]);
        answer_volume(scene, shapes.cone, touching[4]);
        answer_volume(scene, shapes.triangle, touching[5]);
        answer_sweep(scene, shapes.sphere, questions.directions[i], sweeps[0]);
        answer_sweep(scene, shapes.capsule, questions.directions[i], sweeps[1]);
        answer_sweep(scene, shapes.box, questions.directions[i], sweeps[2]);
        answer_sweep(scene, shapes.oriented_box, questions.directions[i], sweeps[3]);
        answer_sweep(scene, questions.hull(i), questions.directions[i], sweeps[4]);
    }
}

}  // namespace

std::vector<espalier::Instance> instances_of(const Questions& questions) {
    std::vector<espalier::Instance> instances;
    for (std::uint32_t i = 0; i < 40; ++i) instances.push_back({questions.place(40 + i), i % 2, 1 + i % 3, 7 * i, 0});
    return instances;
}

void answer_scene(const espalier::BakedScene& scene, const Questions& questions) {
    answer_facts(scene);
    answer_rays(scene, questions);
    answer_shapes(scene, questions);
}
