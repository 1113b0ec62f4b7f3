// The queries of a scene that cost is measured with, as workload.hpp has those of a blob.
#pragma once

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

#include <espalier/scene.hpp>

#include "../platform/fingerprint.hpp"
#include "measured_kinds.hpp"
#include "question_maker.hpp"

namespace espalier::firmware {

/// Queries a scene; `measure(kind, call)` runs each call. Every bit that comes back goes into the fingerprint.
template <class Measure>
class SceneWorkload : QuestionMaker {
public:
    /// The scene is open; its meshes lie in the array.
    SceneWorkload(std::span<const std::byte> bytes, std::span<Blob> meshes, const BakedScene& scene,
                  const Measure& measure)
        : QuestionMaker(scene.bounds()), bytes_(bytes), meshes_(meshes), scene_(scene), measure_(measure) {}

    void ask(std::uint32_t count) {
        open_again();
        for (std::uint32_t i = 0; i < count; ++i) ask();
    }
    [[nodiscard]] const platform::Fingerprint& answers() const { return answers_; }

private:
    void open_again() {
        alignas(BakedScene) std::byte place[sizeof(BakedScene)];
        measure_("open_scene", [&] { new (place) BakedScene(open_scene(bytes_, meshes_)); });
        answers_.add(std::launder(reinterpret_cast<const BakedScene*>(place))->instance_count());
    }

    void ask() {
        const Ray ray = this->ray();
        const Sphere sphere = this->sphere();
        const Vec3 point = point_in_box();
        InScene<RayHit> hit;
        measure_("scene_raycast", [&] { hit = raycast(scene_, ray); });
        answers_.add(bool(hit), hit->t, hit->normal, hit->triangle.index, hit.instance.index);
        YesNo answer;
        measure_("scene_occluded", [&] { answer = occluded(scene_, ray); });
        answers_.add(answer.yes());
        measure_("scene_overlaps_sphere", [&] { answer = overlaps(scene_, sphere); });
        answers_.add(answer.yes());
        InScene<ClosestPoint> nearest;
        measure_("scene_closest_point", [&] { nearest = closest_point(scene_, point); });
        answers_.add(nearest->point, nearest->distance, nearest->triangle.index, nearest.instance.index);
    }

    std::span<const std::byte> bytes_;
    std::span<Blob> meshes_;
    const BakedScene& scene_;
    const Measure& measure_;
    platform::Fingerprint answers_;
};

}  // namespace espalier::firmware
