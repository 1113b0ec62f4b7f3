// Whether code is dearer than time: on microcontrollers, whose flash holds a program and its blobs. The same answers by
// less code; a build for any other machine may ask for it too (the CMake option ESPALIER_SMALL_CODE), as tests do.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#ifndef ESPALIER_SMALL_CODE
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
#define ESPALIER_SMALL_CODE 1
#else
#define ESPALIER_SMALL_CODE 0
#endif
#endif

/// Before a function that is small and asked for in many places: there a copy costs several times the call.
#if ESPALIER_SMALL_CODE
#define ESPALIER_SHARED_CODE [[gnu::noinline]]
/// Before a larger one that is asked for in one place: there a call is what costs.
#define ESPALIER_PART_OF_CALLER [[gnu::always_inline]]
/// Before one that is elsewhere compiled into each caller, for the instructions that the caller may use.
#define ESPALIER_SHARED_OR_PART_OF_CALLER [[gnu::noinline]]
#else
#define ESPALIER_SHARED_CODE
#define ESPALIER_PART_OF_CALLER
#define ESPALIER_SHARED_OR_PART_OF_CALLER [[gnu::always_inline]]
#endif

namespace espalier::detail {

inline constexpr bool small_code = ESPALIER_SMALL_CODE != 0;

/// Of what a vector register, or two, load at once. Cores without such need not waste stack on it.
inline constexpr std::size_t register_alignment = small_code ? 4 : 16;
inline constexpr std::size_t wide_register_alignment = small_code ? 4 : 32;

/// How many bits are set. Small cores have no instruction for it, and the compiler's function is larger.
inline std::uint32_t count_bits(std::uint32_t word) {
    if constexpr (!small_code) return static_cast<std::uint32_t>(std::popcount(word));
    std::uint32_t count = 0;
    for (; word != 0; word &= word - 1) ++count;
    return count;
}

}  // namespace espalier::detail
