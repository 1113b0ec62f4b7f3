#include "espalier.hpp"

#include <runtime/moving_scenes/touching_pairs.hpp>

#include "../../tests/runtime/moving_scenes/made_scene.hpp"
#include "broad_phase.hpp"

namespace espalier::bench::moving {

EspalierBoxes::EspalierBoxes(const Start& start, bool only_moved)
    : scenario_(start.scenario),
      only_moved_(only_moved),
      to_steps_(std::ldexp(1.0f, -start.step_exponent)),
      made_(static_cast<std::uint32_t>(start.boxes.size())) {
    for (const Box& box : start.boxes) made_.insert(in_steps(box));
    detail::repack_boxes(made_.block);
    ++made_.block.head->step;
}

void EspalierBoxes::step(const Frame& frame, Parts& parts, PairList& pairs) {
    detail::SceneBlock& block = made_.block;
    parts.begin();
    for (const Movement& movement : frame.movements) {
        const std::uint32_t number = movement.instance.slot;
        block.slots[number].box = in_steps(frame.boxes[number]);
        block.moved[number] = block.head->step;
        detail::set_box(block, number);
    }
    parts.end(Part::update);
    if (scenario_.repacks_in(frame.number)) {
        detail::repack_boxes(block);
        nodes_renewed_ = block.head->nodes_used;
        parts.end(Part::repack);
    } else {
        nodes_renewed_ = detail::refit_boxes(block);
        parts.end(Part::refit);
    }
    PairFilter filter;
    filter.only_moved = only_moved_;
    pairs.set_count(detail::collect_touching_pairs(block, pairs.room(), filter, {}).count);
    ++block.head->step;
    parts.end(Part::pairs);
}

/// The boxes are whole steps, so that the conversion rounds nothing.
detail::StepsBox EspalierBoxes::in_steps(const Box& box) const {
    const auto steps = [this](float x) { return static_cast<std::int32_t>(x * to_steps_); };
    return {{steps(box.min.x), steps(box.min.y), steps(box.min.z)},
            {steps(box.max.x), steps(box.max.y), steps(box.max.z)}};
}

BroadPhaseMakers espalier_box_makers(const Scenario& scenario) {
    return espalier_makers_of<EspalierBoxes>(scenario, "boxes");
}

namespace {

/// A moving scene through its public calls.
class EspalierPlacements final : public BroadPhase {
public:
    EspalierPlacements(const Start& start, bool only_moved, bool colliding)
        : scenario_(start.scenario),
          colliding_(colliding),
          made_(static_cast<std::uint32_t>(start.instances.size()), start.step_exponent, start.meshes) {
        filter_.only_moved = only_moved;
        for (const Instance& instance : start.instances) check(insert(made_.scene, instance).status);
        repack(made_.scene);
        end_step(made_.scene);
    }
    void step(const Frame& frame, Parts& parts, PairList& pairs) override {
        MovingScene& scene = made_.scene;
        parts.begin();
        check(move(scene, frame.movements).status);
        parts.end(Part::update);
        if (scenario_.repacks_in(frame.number)) {
            repack(scene);
            parts.end(Part::repack);
        } else {
            refit(scene);
            parts.end(Part::refit);
        }
        const FilledPairs<InstancePair> filled =
            colliding_ ? collect_colliding_pairs(scene, pairs.room(), WorkLimit::unlimited(), filter_)
                       : collect_candidate_pairs(scene, pairs.room(), filter_);
        check(filled.status);
        pairs.set_count(filled.count);
        end_step(scene);
        parts.end(Part::pairs);
    }

private:
    static void check(QueryStatus status) {
        if (status != QueryStatus::ok) throw std::runtime_error(describe(status));
    }

    const Scenario& scenario_;
    bool colliding_;
    PairFilter filter_;
    tests::MadeScene made_;
};

}  // namespace

BroadPhaseMakers espalier_placement_makers(const Scenario& scenario) {
    return espalier_makers_of<EspalierPlacements>(scenario, "placements", false);
}

BroadPhaseMakers espalier_colliding_makers() {
    return {maker_of<EspalierPlacements>("espalier", "placements", false, true)};
}

}  // namespace espalier::bench::moving
