// Instances of a moving scene as they are seen from an origin in a world that float32 does not resolve.
#pragma once

#include <cstdint>

#include <espalier/transform.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// Origins are multiples of it, in steps: the difference of two has 24 bits, and is exact as a float.
inline constexpr std::int32_t origin_grid = 128;

constexpr bool are_equal(const std::int32_t (&a)[3], const std::int32_t (&b)[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Returns the transform of an instance, seen from an origin. The translation is rounded once, and not at
/// all if the instance was placed through the same origin.
inline Transform seen_transform(const InstanceSlot& slot, const std::int32_t (&origin)[3], std::int32_t step_exponent) {
    Transform seen = slot.transform;
    if (are_equal(slot.origin, origin)) return seen;
    const float step = power_of_two(step_exponent);
    float* const translation[3] = {&seen.translation.x, &seen.translation.y, &seen.translation.z};
    for (int k = 0; k < 3; ++k)  // the sum with 0 would change zeros with a sign, and subnormal numbers in some modes
        if (slot.origin[k] != origin[k]) *translation[k] += static_cast<float>(slot.origin[k] - origin[k]) * step;
    return seen;
}

/// Returns whether the translation as it is seen from there differs from the one that was given. The instance may then
/// be a step of the lattice away from its neighbours.
inline bool is_rounded_in(const InstanceSlot& slot, const std::int32_t (&origin)[3], std::int32_t step_exponent) {
    const float step = power_of_two(step_exponent);
    const float given[3] = {slot.transform.translation.x, slot.transform.translation.y, slot.transform.translation.z};
    for (int k = 0; k < 3; ++k) {
        if (slot.origin[k] == origin[k]) continue;
        // The sum is exact if it gives back both of its parts (Knuth 1969). Numbers below 2^-100 are apart: what a sum
        // loses of them may be subnormal.
        if (magnitude_bits(given[k]) != 0 && magnitude_bits(given[k]) < magnitude_bits(0x1p-100f)) return true;
        const float way = static_cast<float>(slot.origin[k] - origin[k]) * step, seen = given[k] + way;
        const float added = seen - given[k];
        if (way != added || given[k] != seen - added) return true;
    }
    return false;
}

/// Moves a box that counts from an origin to where it is in the world. False if it leaves the world.
inline bool move_to_world(const std::int32_t (&origin)[3], StepsBox& box) {
    for (int k = 0; k < 3; ++k) {
        // Both are within the world: the sums have 31 bits.
        box.low[k] += origin[k];
        box.high[k] += origin[k];
        if (box.low[k] < -most_world_steps || box.high[k] > most_world_steps) return false;
    }
    return true;
}

}  // namespace espalier::detail
