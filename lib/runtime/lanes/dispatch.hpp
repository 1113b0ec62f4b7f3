// Calls the variant of a query that suits the machine.
#pragma once

#include <runtime/lanes/select.hpp>

#if ESPALIER_X86 && defined(__x86_64__)
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...)                                            \
    (::espalier::detail::instruction_set() == InstructionSet::avx512  ? avx512::query(__VA_ARGS__) \
     : ::espalier::detail::instruction_set() == InstructionSet::avx2  ? avx2::query(__VA_ARGS__)   \
     : ::espalier::detail::instruction_set() == InstructionSet::sse42 ? sse42::query(__VA_ARGS__)  \
                                                                      : without_lanes::query(__VA_ARGS__))
#elif ESPALIER_X86
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...)                                           \
    (::espalier::detail::instruction_set() == InstructionSet::avx2    ? avx2::query(__VA_ARGS__)  \
     : ::espalier::detail::instruction_set() == InstructionSet::sse42 ? sse42::query(__VA_ARGS__) \
                                                                      : without_lanes::query(__VA_ARGS__))
#elif ESPALIER_NEON || ESPALIER_SIMD128
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...) ESPALIER_ONLY_SET::query(__VA_ARGS__)
#else
#define ESPALIER_DISPATCH_OR(without_lanes, query, ...) without_lanes::query(__VA_ARGS__)
#endif

#define ESPALIER_DISPATCH(query, ...) ESPALIER_DISPATCH_OR(scalar, query, __VA_ARGS__)
/// Calls the variant of a query of one ray.
#define ESPALIER_DISPATCH_RAY(query, ...) ESPALIER_DISPATCH_OR(single_rays, query, __VA_ARGS__)
