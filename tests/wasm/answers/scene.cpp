// A baked scene.
#include "scene_queries.hpp"

namespace espalier::answers {

std::vector<Instance> instances_of(const Questions& questions) {
    std::vector<Instance> instances;
    for (std::uint32_t i = 0; i < 40; ++i) instances.push_back({questions.place(40 + i), i % 2, 1 + i % 3, 7 * i, 0});
    return instances;
}

void answer_scene(const BakedScene& scene, const Questions& questions) {
    Words& facts = words["scene_facts"];
    facts.add(scene.instance_count(), scene.meshes().size(), scene.max_error(), scene.bounds().min, scene.bounds().max);
    for (std::uint32_t i = 0; i < scene.instance_count(); ++i)
        facts.add(instance_at(scene, {i, no_instance.in_tile}).value);
    answer_both(scene, questions, "scene_");
}

}  // namespace espalier::answers
