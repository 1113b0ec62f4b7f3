// Queries of a scene, baked or moving.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <espalier/scenes/moving_scene.hpp>

#include "questions.hpp"
#include "words.hpp"

namespace espalier::answers {

/// Adds the elements that walk(add) adds, and the status that it returns. A moving scene visits in the order of its
/// tree: its lists are sorted by slot, and a refused query has none.
template <class Scene, class Item, class Walk>
void add_list(Words& list, const Walk& walk) {
    std::vector<std::pair<InstanceId, Item>> items;
    const QueryStatus status = walk([&](InstanceId instance, const Item& item) { items.emplace_back(instance, item); });
    if constexpr (std::is_same_v<Scene, MovingScene>) {
        if (is_refused(status)) items.clear();
        std::ranges::stable_sort(items, {}, [](const auto& item) { return item.first.index; });
    }
    for (const auto& [instance, item] : items) {
        if constexpr (std::is_same_v<Item, TriangleId>) list.add(instance, item);
        else list.add(item, instance);
    }
    list.add(status);
}

template <class Scene>
void answer_scene_queries(const Scene& scene, const Questions& questions, const std::string& prefix,
                          const SceneFilter& filter) {
    for (std::size_t i = 0; i < questions.count(); ++i) {
        const Ray ray = questions.ray(i, FaceCulling::back);
        words[prefix + "raycast"].add(raycast(scene, ray, filter));
        words[prefix + "occluded"].add(occluded(scene, ray, filter).status());
        add_list<Scene, RayHit>(words[prefix + "all_hits"],
                                [&](const auto& visit) { return for_each_hit(scene, ray, visit, filter); });
        words[prefix + "closest_point"].add(closest_point(scene, questions.origins[i], 2.5f, filter.mask()));
        questions.for_each_volume(i, [&](const char* name, const auto& volume) {
            words[prefix + name].add(overlaps(scene, volume, filter).status());
            add_list<Scene, TriangleId>(words[prefix + name], [&](const auto& visit) {
                return for_each_overlap(scene, volume, visit, filter);
            });
        });
        questions.for_each_body(i, [&](const char* name, const auto& body) {
            SceneSweepOptions options;
            options.filter = filter;
            options.culling = FaceCulling::back;
            options.ignore_leaving = true;
            options.skin = 0.01f;
            words[prefix + name].add(sweep(scene, body, questions.directions[i], options));
        });
    }
}

/// Answers of the instances of a mask, and of those alone that a filter keeps.
template <class Scene>
void answer_both(const Scene& scene, const Questions& questions, const std::string& prefix) {
    constexpr auto keep = [](InstanceId instance, TriangleId) { return instance.index % 4 != 2; };
    answer_scene_queries(scene, questions, prefix, SceneFilter(2));
    answer_scene_queries(scene, questions, "filtered_" + prefix, SceneFilter(2, keep));
}

}  // namespace espalier::answers
