#include <stdexcept>

#include "../../../tests/runtime/moving_scenes/made_scene.hpp"
#include "../broad_phase.hpp"

namespace espalier::bench {
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
    if (scenario.moving >= 1.0) return {maker_of<EspalierPlacements>("espalier", "placements", false, false)};
    BroadPhaseMakers makers = {maker_of<EspalierPlacements>("espalier", "placements", true, false),
                               maker_of<EspalierPlacements>("espalier, all pairs", "placements", false, false)};
    makers[0].finds = Finds::of_movers;
    return makers;
}

BroadPhaseMakers espalier_colliding_makers() {
    return {maker_of<EspalierPlacements>("espalier", "placements", false, true)};
}

}  // namespace espalier::bench
