// Selects the instruction set that queries run on, and calls their variant for it.
#pragma once

#include <cstdint>

#include <runtime/base/options.hpp>

#if ESPALIER_X86
#include <cpuid.h>
#endif

/// Whether a set of x86 is a part of this build.
#define ESPALIER_HAS_SSE42 (ESPALIER_X86 && ESPALIER_SET_SSE42)
#define ESPALIER_HAS_AVX2 (ESPALIER_X86 && ESPALIER_SET_AVX2)
#if defined(__x86_64__)
#define ESPALIER_HAS_AVX512 (ESPALIER_X86 && ESPALIER_SET_AVX512)
#else
#define ESPALIER_HAS_AVX512 0
#endif

/// The instruction set of all queries, where it is known without a test of the processor.
#if ESPALIER_NEON
#define ESPALIER_ONLY_SET neon
#elif ESPALIER_SIMD128
#define ESPALIER_ONLY_SET simd128
#else
#define ESPALIER_ONLY_SET scalar
#endif

/// Declares functions once for each instruction set of this program, in the namespace of each. `small` is the code of
/// small cores, which has queries of one ray alone.
#define ESPALIER_IN_EACH_SET(...) \
    ESPALIER_IN_SET(small, __VA_ARGS__) ESPALIER_IN_SET(scalar, __VA_ARGS__) ESPALIER_IN_SETS_WITH_LANES(__VA_ARGS__)
#if ESPALIER_X86
#define ESPALIER_IN_SETS_WITH_LANES(...) \
    ESPALIER_IN_SET(sse42, __VA_ARGS__) ESPALIER_IN_SET(avx2, __VA_ARGS__) ESPALIER_IN_SET(avx512, __VA_ARGS__)
#else
#define ESPALIER_IN_SETS_WITH_LANES(...) ESPALIER_IN_SET(ESPALIER_ONLY_SET, __VA_ARGS__)
#endif
#define ESPALIER_IN_SET(set, ...) \
    namespace set {               \
    __VA_ARGS__                   \
    }

namespace espalier::detail {

enum class InstructionSet : std::uint8_t { scalar, sse42, avx2, avx512, neon, simd128 };

#if ESPALIER_X86

/// Returns whether a set is a part of this build.
constexpr bool is_built(InstructionSet set) {
    return set == InstructionSet::scalar || (ESPALIER_HAS_SSE42 && set == InstructionSet::sse42) ||
           (ESPALIER_HAS_AVX2 && set == InstructionSet::avx2) || (ESPALIER_HAS_AVX512 && set == InstructionSet::avx512);
}

/// Returns the best set that the processor and the operating system support.
inline InstructionSet set_of_machine() {
    unsigned a = 0, b = 0, c = 0, d = 0;
    if (__get_cpuid(1, &a, &b, &c, &d) == 0) return InstructionSet::scalar;
    constexpr unsigned ssse3 = 1u << 9, sse41 = 1u << 19, sse42 = 1u << 20, popcnt = 1u << 23;
    constexpr unsigned fma = 1u << 12, os_saves = 1u << 27, avx = 1u << 28;
    if ((c & (ssse3 | sse41 | sse42 | popcnt)) != (ssse3 | sse41 | sse42 | popcnt)) return InstructionSet::scalar;
    if ((c & (fma | os_saves | avx)) != (fma | os_saves | avx)) return InstructionSet::sse42;
    unsigned saved = 0, saved_high = 0;
    __asm__("xgetbv" : "=a"(saved), "=d"(saved_high) : "c"(0));
    if ((saved & 6u) != 6u || __get_cpuid_count(7, 0, &a, &b, &c, &d) == 0) return InstructionSet::sse42;
    constexpr unsigned bmi1 = 1u << 3, avx2 = 1u << 5, bmi2 = 1u << 8;
    if ((b & (bmi1 | avx2 | bmi2)) != (bmi1 | avx2 | bmi2)) return InstructionSet::sse42;
    if (__get_cpuid(0x80000001u, &a, &b, &c, &d) == 0 || (c & (1u << 5)) == 0) return InstructionSet::sse42;  // lzcnt
#if defined(__x86_64__)
    // Ice Lake, Zen 4 and later: registers of 512 bits, and within them bytes that are moved and expanded.
    constexpr unsigned high_state = 0xE0,
                       all_of_7 = 1u << 16 | 1u << 17 | 1u << 28 | 1u << 30 | 1u << 31;  // F DQ CD BW VL
    constexpr unsigned vbmi = 1u << 1, vbmi2 = 1u << 6;
    __get_cpuid_count(7, 0, &a, &b, &c, &d);
    if ((saved & high_state) == high_state && (b & all_of_7) == all_of_7 && (c & (vbmi | vbmi2)) == (vbmi | vbmi2))
        return InstructionSet::avx512;
#endif
    return InstructionSet::avx2;
}

/// Returns the best set that the machine supports and this build has. Each query would have a copy of it if it were
/// inlined.
ESPALIER_NOINLINE inline InstructionSet detect_instruction_set() {
    InstructionSet set = set_of_machine();
    while (!is_built(set)) set = static_cast<InstructionSet>(static_cast<unsigned>(set) - 1u);
    return set;
}

/// 0 until it is detected, else the set + 1. Tests write it to run every query on a lesser set.
inline std::uint8_t known_instruction_set = 0;

/// Detects the set once, since cpuid is slow on virtual machines. Threads that race here store the same value.
inline InstructionSet instruction_set() {
    std::uint8_t value = __atomic_load_n(&known_instruction_set, __ATOMIC_RELAXED);
    if (value == 0) {
        value = static_cast<std::uint8_t>(static_cast<unsigned>(detect_instruction_set()) + 1u);
        __atomic_store_n(&known_instruction_set, value, __ATOMIC_RELAXED);
    }
    return static_cast<InstructionSet>(value - 1);
}

#else

constexpr InstructionSet instruction_set() { return InstructionSet::ESPALIER_ONLY_SET; }

#endif

}  // namespace espalier::detail

// The beginning of a conditional expression: calls a set's variant of a query if the machine runs that set, else
// evaluates what follows. Nothing for a set that is not a part of this build.
#if ESPALIER_HAS_SSE42
#define ESPALIER_SSE42_OR(query, arguments) \
    ::espalier::detail::instruction_set() == InstructionSet::sse42 ? sse42::query arguments:
#else
#define ESPALIER_SSE42_OR(query, arguments)
#endif
#if ESPALIER_HAS_AVX2
#define ESPALIER_AVX2_OR(query, arguments) \
    ::espalier::detail::instruction_set() == InstructionSet::avx2 ? avx2::query arguments:
#else
#define ESPALIER_AVX2_OR(query, arguments)
#endif
#if ESPALIER_HAS_AVX512
#define ESPALIER_AVX512_OR(query, arguments) \
    ::espalier::detail::instruction_set() == InstructionSet::avx512 ? avx512::query arguments:
#else
#define ESPALIER_AVX512_OR(query, arguments)
#endif

#if ESPALIER_X86
/// Calls the variant of a query that the machine runs; `without_lanes` has the scalar one.
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...)                              \
    (ESPALIER_AVX512_OR(query, (__VA_ARGS__)) ESPALIER_AVX2_OR(query, (__VA_ARGS__)) \
         ESPALIER_SSE42_OR(query, (__VA_ARGS__)) without_lanes::query(__VA_ARGS__))
#elif ESPALIER_NEON || ESPALIER_SIMD128
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...) ESPALIER_ONLY_SET::query(__VA_ARGS__)
#else
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...) without_lanes::query(__VA_ARGS__)
#endif

#define ESPALIER_DISPATCH(query, ...) ESPALIER_DISPATCH_OR(scalar, query, __VA_ARGS__)
/// Calls the variant of a query of one ray.
#define ESPALIER_DISPATCH_RAY(query, ...) ESPALIER_DISPATCH_OR(single_rays, query, __VA_ARGS__)
