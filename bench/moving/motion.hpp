// Objects that fly through a cubic world, as in Broadmark (Serpa and Rodrigues 2019).
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/transform.hpp>

#include "../../tests/support/base/random.hpp"
#include "scenario.hpp"

namespace espalier::bench {

/// Middles are uniform in the world, velocities in a ball. Each step draws the velocity of one moving object in a
/// hundred anew; walls reflect. The same scenario gives the same motion.
class Motion {
public:
    explicit Motion(const Scenario& scenario);
    void step();

    [[nodiscard]] float side() const { return side_; }  ///< of the world, which begins at the origin
    [[nodiscard]] const std::vector<float>& edges() const { return edges_; }
    /// Returns the numbers of the objects that move, in ascending order.
    [[nodiscard]] const std::vector<std::uint32_t>& movers() const { return movers_; }
    /// Returns the place of a cube of edge 1 around the origin.
    [[nodiscard]] Transform place(std::uint32_t object) const {
        return {rotations_[object], middles_[object], edges_[object]};
    }

private:
    void draw_velocity(std::uint32_t mover);
    Vec3 in_ball(float radius);
    Quaternion any_rotation();

    tests::Random random_;
    float speed_;
    float side_ = 0.0f;
    bool turning_;
    std::vector<float> edges_;
    std::vector<std::uint32_t> movers_;
    std::vector<Vec3> middles_;
    std::vector<Quaternion> rotations_;
    std::vector<Vec3> velocities_;   ///< of the movers
    std::vector<Quaternion> spins_;  ///< of the movers, a step's rotation
};

}  // namespace espalier::bench
