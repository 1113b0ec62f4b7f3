// Floats moved outward by one step, so that what holds for exact numbers holds for rounded ones. Independent of whether
// the machine flushes subnormal numbers: none are made.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// The next larger float that is normal; infinity stays. x is a number.
inline float next_above(float x) {
    if (magnitude_bits(x) < 0x00800000u) return 0x1p-126f;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    if (bits == infinity_bits) return x;
    return flush_subnormal(std::bit_cast<float>(is_negative(x) ? bits - 1 : bits + 1));
}
inline float next_below(float x) { return -next_above(-x); }

/// An upper and a lower bound of a lattice coordinate, from 0 to 2^27 steps, in local space: of the exact one and of
/// the one that to_local gives.
inline float world_above(const BlobData& blob, int axis, std::int32_t steps) {
    auto whole = static_cast<float>(steps);
    if (steps > 1 << 24) whole = next_above(whole);
    return next_above(flush_subnormal(blob.origin[axis] + whole * power_of_two(blob.step_exponent)));
}
inline float world_below(const BlobData& blob, int axis, std::int32_t steps) {
    auto whole = static_cast<float>(steps);
    if (steps > 1 << 24) whole = next_below(whole);
    return next_below(flush_subnormal(blob.origin[axis] + whole * power_of_two(blob.step_exponent)));
}

}  // namespace espalier::detail
