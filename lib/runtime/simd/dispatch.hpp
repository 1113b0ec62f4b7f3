// Calls the variant of a query that suits the machine.
#pragma once

#include <runtime/simd/select.hpp>

#if ESPALIER_X86 && defined(__x86_64__)
#define ESPALIER_DISPATCH(query, ...)                                                              \
    (::espalier::detail::instruction_set() == InstructionSet::avx512  ? avx512::query(__VA_ARGS__) \
     : ::espalier::detail::instruction_set() == InstructionSet::avx2  ? avx2::query(__VA_ARGS__)   \
     : ::espalier::detail::instruction_set() == InstructionSet::sse42 ? sse42::query(__VA_ARGS__)  \
                                                                      : scalar::query(__VA_ARGS__))
#elif ESPALIER_X86
#define ESPALIER_DISPATCH(query, ...)                                                             \
    (::espalier::detail::instruction_set() == InstructionSet::avx2    ? avx2::query(__VA_ARGS__)  \
     : ::espalier::detail::instruction_set() == InstructionSet::sse42 ? sse42::query(__VA_ARGS__) \
                                                                      : scalar::query(__VA_ARGS__))
#elif ESPALIER_NEON
#define ESPALIER_DISPATCH(query, ...) neon::query(__VA_ARGS__)
#elif ESPALIER_SIMD128
#define ESPALIER_DISPATCH(query, ...) simd128::query(__VA_ARGS__)
#else
#define ESPALIER_DISPATCH(query, ...) scalar::query(__VA_ARGS__)
#endif

/// The same for single rays: where code is dearer than time, those go their own way.
#if ESPALIER_SMALL_CODE
#define ESPALIER_DISPATCH_RAY(query, ...) small::query(__VA_ARGS__)
#else
#define ESPALIER_DISPATCH_RAY(query, ...) ESPALIER_DISPATCH(query, __VA_ARGS__)
#endif
