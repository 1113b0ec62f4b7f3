// The tree over boxes of a moving scene, without placements and meshes.
#pragma once

#include "../../tests/runtime/moving_scenes/made_block.hpp"
#include "broad_phase.hpp"

namespace espalier::bench::moving {

/// Slots are the numbers of objects.
class EspalierBoxes final : public BroadPhase {
public:
    EspalierBoxes(const Start& start, bool only_moved);
    void step(const Frame& frame, Parts& parts, PairList& pairs) override;

    [[nodiscard]] const detail::SceneBlock& block() const { return made_.block; }
    /// Returns how many nodes the last step wrote.
    [[nodiscard]] std::uint32_t nodes_renewed() const { return nodes_renewed_; }

private:
    [[nodiscard]] detail::StepsBox in_steps(const Box& box) const;

    const Scenario& scenario_;
    bool only_moved_;
    float to_steps_;
    std::uint32_t nodes_renewed_ = 0;
    tests::MadeBlock made_;
};

}  // namespace espalier::bench::moving
