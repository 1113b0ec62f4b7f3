// A step of a simulation that cost is measured with: 64 cubes that move through each other, in the fewest bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>

#include "../platform/fingerprint.hpp"
#include "measured_kinds.hpp"

namespace espalier::firmware {

inline constexpr std::uint32_t mover_count = 64;
/// least_moving_scene_bytes(mover_count) bytes are needed.
inline constexpr std::size_t mover_block_bytes = 8956;

/// Where the movers are: functions of their number and the step, in whole numbers.
class MoverPlaces {
public:
    static Transform at(std::uint32_t mover, std::uint32_t step) {
        Transform transform;
        const auto turn = [&](std::uint32_t k) { return static_cast<float>(number(mover, k, 4)); };
        transform.rotation = {turn(0), turn(1), turn(2), 5.0f};
        const auto place = [&](std::uint32_t k, std::uint32_t cell) {
            return folded(static_cast<std::int32_t>(cell) * 3 * unit +
                          number(mover, 3 + k, 4) * static_cast<std::int32_t>(step));
        };
        transform.translation = {place(0, mover % 4), place(1, mover / 4 % 4), place(2, mover / 16)};
        return transform;
    }

private:
    static constexpr std::int32_t unit = 64;         ///< the side of a cube
    static constexpr std::int32_t side = 12 * unit;  ///< of the box that they stay in

    /// Returns a number from -most to most.
    static std::int32_t number(std::uint32_t mover, std::uint32_t of, std::uint32_t most) {
        std::uint32_t h = mover * 0x9E3779B1u ^ of * 0x85EBCA77u;
        h = (h ^ h >> 15) * 0x2C1B3C6Du;
        h = (h ^ h >> 12) * 0x297A2D39u;
        return static_cast<std::int32_t>((h >> 8) % (2 * most + 1)) - static_cast<std::int32_t>(most);
    }
    /// Returns a coordinate that turns round at both sides of the box.
    static float folded(std::int32_t way) {
        const std::int32_t past = (way % (2 * side) + 2 * side) % (2 * side);
        return static_cast<float>(past < side ? past : 2 * side - past) / unit;
    }
};

/// Steps a moving scene; `measure(kind, call)` runs each step. All pairs go into the fingerprint.
template <class Measure>
class MovingWorkload {
public:
    MovingWorkload(std::span<std::byte> block, const Blob& cube, const Measure& measure)
        : scene_(create_moving_scene(block, mover_count, -10, std::span(&cube, 1))), measure_(measure) {
        for (std::uint32_t i = 0; i < mover_count; ++i) {
            Instance instance;
            instance.transform = MoverPlaces::at(i, first_step);
            movements_[i] = {*insert(scene_, instance), instance.transform};
        }
    }

    void ask(std::uint32_t steps) {
        for (std::uint32_t step = 1; step <= steps; ++step) {
            for (std::uint32_t i = 0; i < mover_count; ++i)
                movements_[i].transform = MoverPlaces::at(i, first_step + step);
            ask(step % 8 == 0);
        }
    }
    [[nodiscard]] const platform::Fingerprint& answers() const { return answers_; }

private:
    static constexpr std::uint32_t first_step = 16;  ///< when movers have left their places on the grid

    void ask(bool with_repack) {
        QueryStatus moved = QueryStatus::not_open;
        FilledPairs<InstancePair> found;
        measure_(with_repack ? Kind("moving_step_repack") : Kind("moving_step"), [&] {
            moved = move(scene_, movements_).status;
            if (with_repack) repack(scene_);
            else refit(scene_);
            found = collect_candidate_pairs(scene_, pairs_);
            end_step(scene_);
        });
        answers_.add(static_cast<std::uint32_t>(moved), static_cast<std::uint32_t>(found.status));
        for (const InstancePair& pair : found.in(pairs_)) answers_.add(mover_count * pair.a + pair.b);
    }

    MovingScene scene_;
    const Measure& measure_;
    Movement movements_[mover_count];
    InstancePair pairs_[128];
    platform::Fingerprint answers_;
};

}  // namespace espalier::firmware
