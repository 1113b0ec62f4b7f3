// The place of a point on Hilbert's curve through a cube.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace espalier::detail {

/// A step down one level of the curve: for each octant its number along the curve, and the state below it (Hamilton
/// and Rau-Chaplin 2008). A state is the corner where the curve enters and the direction in which it leaves.
struct HilbertStep {
    std::uint8_t number;
    std::uint8_t state;
};
inline constexpr auto hilbert_steps = [] {
    const auto turned_left = [](unsigned x, unsigned by) { return (x << by % 3 | x >> (3 - by % 3) % 3) & 7u; };
    const auto rotate_left = [turned_left](unsigned x, unsigned by) { return by % 3 == 0 ? x : turned_left(x, by); };
    const auto gray = [](unsigned x) { return x ^ x >> 1; };
    std::array<std::array<HilbertStep, 8>, 24> steps{};
    for (unsigned entry = 0; entry < 8; ++entry)
        for (unsigned direction = 0; direction < 3; ++direction)
            for (unsigned octant = 0; octant < 8; ++octant) {
                const unsigned turned = rotate_left(octant ^ entry, 3 - (direction + 1) % 3);
                unsigned number = turned;
                number ^= number >> 1;
                number ^= number >> 2;
                const unsigned enters = number == 0 ? 0 : gray((number - 1) / 2 * 2);
                const unsigned trailing =
                    number == 0 ? 0 : static_cast<unsigned>(std::countr_one(number % 2 == 0 ? number - 1 : number)) % 3;
                const unsigned entry_below = entry ^ rotate_left(enters, (direction + 1) % 3);
                const unsigned direction_below = (direction + trailing + 1) % 3;
                steps[entry * 3 + direction][octant] = {static_cast<std::uint8_t>(number),
                                                        static_cast<std::uint8_t>(entry_below * 3 + direction_below)};
            }
    return steps;
}();

/// Returns the place of a point along the curve; coordinates have `bits` bits each, at most 10.
constexpr std::uint32_t hilbert_key(std::uint32_t x, std::uint32_t y, std::uint32_t z, unsigned bits) {
    std::uint32_t key = 0, state = 0;
    for (unsigned bit = bits; bit-- > 0;) {
        const std::uint32_t octant = (x >> bit & 1u) | (y >> bit & 1u) << 1 | (z >> bit & 1u) << 2;
        const HilbertStep step = hilbert_steps[state][octant];
        key = key << 3 | step.number;
        state = step.state;
    }
    return key;
}

}  // namespace espalier::detail
