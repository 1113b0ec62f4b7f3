// What a run simulates and how often it repeats it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::bench {

enum class Sizes {
    cubes,  ///< all edges are 1
    mixed,  ///< edges are 1 + 99 u^10 for a uniform u, those of bepuphysics' tests of its trees
};

struct Scenario {
    std::size_t objects = 10'000;
    double speed = 0.02;   ///< an object's largest step in multiples of its edge
    double moving = 1.0;   ///< the share of objects that ever moves
    bool turning = false;  ///< objects also turn
    Sizes sizes = Sizes::cubes;
    std::size_t unmeasured = 200;  ///< steps before those that are measured
    std::size_t steps = 40;
    std::size_t repeats = 5;
    std::vector<std::string> only;  ///< names of systems; all if it is empty

    /// Returns after how many steps a tree is packed anew.
    [[nodiscard]] std::size_t steps_between_repacks() const { return moving < 1.0 ? 32 : 8; }
    [[nodiscard]] bool repacks_in(std::size_t step) const {
        return step % steps_between_repacks() == steps_between_repacks() - 1;
    }
};

inline constexpr std::uint64_t moving_seed = 2026;

}  // namespace espalier::bench
