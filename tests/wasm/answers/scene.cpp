// A baked scene.
#include "scene_queries.hpp"

namespace {

void answer_facts(const espalier::BakedScene& scene) {
    Words facts("scene_facts");
    facts.add(scene.instance_count(), scene.meshes().size(), scene.max_error(), scene.bounds().min, scene.bounds().max);
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i) {
        const espalier::Instance instance = espalier::instance_at(scene, {i, espalier::no_instance.in_tile}).value;
        add(facts, instance);
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
    SceneAnswers(scene, questions, "scene_", false).write();
    SceneAnswers(scene, questions, "filtered_scene_", true).write();
}
