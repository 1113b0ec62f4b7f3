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

#if defined(__SSE2__) || defined(__aarch64__) || (defined(__ARM_FP) && (__ARM_FP & 4)) || defined(__riscv_flen) || \
    defined(__s390x__) || defined(__wasm__)
inline constexpr bool has_square_root = true;
#else
inline constexpr bool has_square_root = false;
#endif

/// The core's instruction. Where the compiler has to care for errno, its own way would also call libm's sqrtf.
inline float square_root_by_instruction(float x) {
    float root = x;
#if defined(__NO_MATH_ERRNO__)
    root = __builtin_sqrtf(x);
#elif defined(__SSE2__)
    asm("sqrtss %1, %0" : "=x"(root) : "x"(x));
#elif defined(__aarch64__)
    asm("fsqrt %s0, %s1" : "=w"(root) : "w"(x));
#elif defined(__ARM_FP) && (__ARM_FP & 4)
    asm("vsqrt.f32 %0, %1" : "=t"(root) : "t"(x));
#elif defined(__riscv_flen)
    asm("fsqrt.s %0, %1" : "=f"(root) : "f"(x));
#elif defined(__s390x__)
    asm("sqebr %0, %1" : "=f"(root) : "f"(x));
#elif defined(__wasm__)
    asm("local.get %1\n\tf32.sqrt\n\tlocal.set %0" : "=r"(root) : "r"(x));
#endif
    return root;
}

/// The square root of zero or of a positive, normal and finite number.
inline float square_root(float x) {
    if constexpr (has_square_root) return square_root_by_instruction(x);
    else return square_root_in_integers(x);
}

}  // namespace espalier::detail
