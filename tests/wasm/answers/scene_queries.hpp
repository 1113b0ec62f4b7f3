// Queries of a scene, baked or moving.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <espalier/scene.hpp>
#include <espalier/scenes/moving_scene.hpp>

#include "questions.hpp"
#include "words.hpp"

/// The instances that queries take into account.
constexpr std::uint32_t scene_mask = 2;
/// Those that a filter keeps.
constexpr auto keep_instance = [](espalier::InstanceId instance, espalier::TriangleId) {
    return instance.index % 4 != 2;
};

template <class Hit>
void add(Words& words, const espalier::InScene<Hit>& found) {
    add(words, found.hit);
    words.add(found.instance);
}

/// Answers about a scene, in files whose names begin with a prefix.
template <class Scene>
class SceneAnswers {
public:
    SceneAnswers(const Scene& scene, const Questions& questions, std::string prefix, bool is_filtered)
        : scene_(scene), questions_(questions), prefix_(std::move(prefix)), is_filtered_(is_filtered) {}

    void write() const {
        answer_rays();
        answer_shapes();
    }

private:
    [[nodiscard]] espalier::SceneFilter filter() const {
        return is_filtered_ ? espalier::SceneFilter(scene_mask, keep_instance) : espalier::SceneFilter(scene_mask);
    }

    /// Adds the elements that walk(add) adds, and the status that it returns. A moving scene visits in the order of its
    /// tree: its lists are sorted by slot, and a refused query has none.
    template <class Item, class Walk>
    static void add_list(Words& words, const Walk& walk) {
        std::vector<std::pair<espalier::InstanceId, Item>> items;
        const espalier::QueryStatus status =
            walk([&](espalier::InstanceId instance, const Item& item) { items.emplace_back(instance, item); });
        if constexpr (std::is_same_v<Scene, espalier::MovingScene>) {
            if (espalier::is_refused(status)) items.clear();
            std::stable_sort(items.begin(), items.end(),
                             [](const auto& a, const auto& b) { return a.first.index < b.first.index; });
        }
        for (const auto& [instance, item] : items) {
            if constexpr (std::is_same_v<Item, espalier::TriangleId>) {
                words.add(instance, item);
            } else {
                add(words, item);
                words.add(instance);
            }
        }
        words.add(status);
    }

    void answer_rays() const {
        Words closest(prefix_ + "raycast");
        Words any(prefix_ + "occluded");
        Words all(prefix_ + "all_hits");
        Words nearest(prefix_ + "closest_point");
        for (std::size_t i = 0; i < questions_.origins.size(); ++i) {
            espalier::Ray ray = questions_.ray(i);
            ray.culling = espalier::FaceCulling::back;
            add(closest, espalier::raycast(scene_, ray, filter()));
            any.add(espalier::occluded(scene_, ray, filter()).status());
            add_list<espalier::RayHit>(
                all, [&](const auto& visit) { return espalier::for_each_hit(scene_, ray, visit, filter()); });
            add(nearest, espalier::closest_point(scene_, questions_.origins[i], 2.5f, scene_mask));
        }
    }

    template <class Shape>
    void answer_volume(const Shape& shape, Words& words) const {
        words.add(espalier::overlaps(scene_, shape, filter()).status());
        add_list<espalier::TriangleId>(
            words, [&](const auto& visit) { return espalier::for_each_overlap(scene_, shape, visit, filter()); });
    }

    template <class Shape>
    void answer_sweep(const Shape& shape, espalier::Vec3 displacement, Words& words) const {
        espalier::SceneSweepOptions options;
        options.filter = filter();
        options.culling = espalier::FaceCulling::back;
        options.ignore_leaving = true;
        options.skin = 0.01f;
        add(words, espalier::sweep(scene_, shape, displacement, options));
    }

    void answer_shapes() const {
        Words touching[] = {Words(prefix_ + "sphere"),       Words(prefix_ + "capsule"), Words(prefix_ + "box"),
                            Words(prefix_ + "oriented_box"), Words(prefix_ + "cone"),    Words(prefix_ + "triangle")};
        Words sweeps[] = {Words(prefix_ + "sweep_sphere"), Words(prefix_ + "sweep_capsule"),
                          Words(prefix_ + "sweep_box"), Words(prefix_ + "sweep_oriented_box"),
                          Words(prefix_ + "sweep_convex_hull")};
        for (std::size_t i = 0; i < questions_.origins.size(); ++i) {
            const Shapes shapes = questions_.shapes(i);
            const espalier::Vec3 displacement = questions_.directions[i];
            answer_volume(shapes.sphere, touching[0]);
            answer_volume(shapes.capsule, touching[1]);
            answer_volume(shapes.box, touching[2]);
            answer_volume(shapes.oriented_box, touching[3]);
            answer_volume(shapes.cone, touching[4]);
            answer_volume(shapes.triangle, touching[5]);
            answer_sweep(shapes.sphere, displacement, sweeps[0]);
            answer_sweep(shapes.capsule, displacement, sweeps[1]);
            answer_sweep(shapes.box, displacement, sweeps[2]);
            answer_sweep(shapes.oriented_box, displacement, sweeps[3]);
            answer_sweep(questions_.hull(i), displacement, sweeps[4]);
        }
    }

    const Scene& scene_;
    const Questions& questions_;
    std::string prefix_;
    bool is_filtered_;
};
