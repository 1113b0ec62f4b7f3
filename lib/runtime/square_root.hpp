// Correctly rounded square roots without a libm: the core's instruction where it has one.
#pragma once

#include <bit>
#include <cstdint>

#include <runtime/float_bits.hpp>

namespace espalier::detail {

/// For cores without the instruction: one result bit a step, exact. x is zero, or positive, normal and finite.
inline float square_root_in_integers(float x) {
    if (magnitude_bits(x) == 0) return x;
    int exponent = exponent_of(x);
    std::uint64_t radicand = (magnitude_bits(x) & 0x007FFFFFu) | 0x00800000u;
    if ((exponent & 1) != 0) {
        radicand <<= 1;
        --exponent;
    }
    // radicand * 2^25 lies in [2^48, 2^50): its root has 25 bits, one more than float keeps, and is never a tie.
    radicand <<= 25;
    std::uint64_t root = 0;
    for (std::uint64_t bit = std::uint64_t{1} << 24; bit != 0; bit >>= 1)
        if ((root | bit) * (root | bit) <= radicand) root |= bit;
    const std::uint32_t rounded = static_cast<std::uint32_t>((root >> 1) + (root & 1));
    return std::bit_cast<float>((static_cast<std::uint32_t>(exponent / 2 + 127 - 1) << 23) + rounded);
}

/// The square root of zero or of a positive, normal and finite number.
inline float square_root(float x) {
#if defined(__SSE2__) || defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & 4)) || defined(__riscv_flen) || \
    defined(__s390x__)
    return __builtin_sqrtf(x);
#else
    return square_root_in_integers(x);
#endif
}

}  // namespace espalier::detail
