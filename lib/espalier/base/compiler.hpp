// Compiler extensions that the library uses beyond standard C++, each behind a macro of ours. GCC and Clang provide all
// of them; c/attributes.h is the counterpart for C. Internal to the library.
#pragma once

#if defined(__GNUC__) || defined(__clang__)  // Clang does not define __GNUC__ in its Microsoft mode

/// Inlines a function into every caller. Lambdas take the second form, after their parameters.
#define ESPALIER_ALWAYS_INLINE [[gnu::always_inline]]
#define ESPALIER_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))
/// Keeps a function out of line, in a frame of its own.
#define ESPALIER_NOINLINE [[gnu::noinline]]
/// Keeps a function out of line and prevents the compiler from cloning it.
#if defined(__clang__)
#define ESPALIER_ONE_COPY [[gnu::noinline]]
#else
#define ESPALIER_ONE_COPY [[gnu::noinline, gnu::noclone]]
#endif

/// Copies bytes; the second form allows the two ranges to overlap. Inline where the count is a constant, and
/// independent of any library.
#define ESPALIER_COPY_BYTES(to, from, count) __builtin_memcpy(to, from, count)
#define ESPALIER_MOVE_BYTES(to, from, count) __builtin_memmove(to, from, count)
#define ESPALIER_PREFETCH(at) __builtin_prefetch(at)
#define ESPALIER_LAUNDER(pointer) __builtin_launder(pointer)
/// Absolute value and square root: a single instruction each where the machine has it.
#define ESPALIER_ABSOLUTE(x) __builtin_fabsf(x)
#define ESPALIER_SQUARE_ROOT(x) __builtin_sqrtf(x)

/// Declares a SIMD type: `using Four ESPALIER_VECTOR_BYTES(16) = float`. Operators act on each element.
#define ESPALIER_VECTOR_BYTES(bytes) [[gnu::vector_size(bytes)]]
/// Converts each element of a vector; picks elements of one or two vectors by constant indices.
#define ESPALIER_CONVERT_VECTOR(vector, To) __builtin_convertvector(vector, To)
#define ESPALIER_SHUFFLE_VECTOR(...) __builtin_shufflevector(__VA_ARGS__)
#if defined(__SSE2__)
/// Packs two vectors of four 32-bit integers into one of eight 16-bit integers, with saturation.
#define ESPALIER_PACK_SATURATED(a, b) __builtin_ia32_packssdw128(a, b)
#endif

/// Hides a value from the optimiser, so that nothing that depends on it is hoisted out of a loop. `place` is the
/// constraint letter of a kind of register: "r" is general-purpose.
#define ESPALIER_AS_IF_CHANGED(x, place) __asm__ volatile("" : "+" place(x))

#if defined(__SIZEOF_INT128__)
namespace espalier::detail {

__extension__ using NativeInt128 = __int128;
__extension__ using NativeUnsignedInt128 = unsigned __int128;

}  // namespace espalier::detail
#endif

#define ESPALIER_PRAGMA(text) _Pragma(#text)
/// Encloses code for which GCC warns that a variable may be uninitialised, because it cannot prove otherwise.
#if defined(__clang__)
#define ESPALIER_BEGIN_MAYBE_UNINITIALIZED
#define ESPALIER_END_MAYBE_UNINITIALIZED
#else
#define ESPALIER_BEGIN_MAYBE_UNINITIALIZED                          \
    ESPALIER_PRAGMA(GCC diagnostic push)                            \
    ESPALIER_PRAGMA(GCC diagnostic ignored "-Wmaybe-uninitialized") \
    ESPALIER_PRAGMA(GCC diagnostic ignored "-Wuninitialized")
#define ESPALIER_END_MAYBE_UNINITIALIZED ESPALIER_PRAGMA(GCC diagnostic pop)
#endif
/// Encloses code compiled for extra instruction-set features. We mark regions instead of passing compiler flags to
/// whole files, since flags would leak wide instructions into inline functions that other files share. Include every
/// header before a region begins. Inside it, reinterpret vectors with __builtin_bit_cast: std::bit_cast is a function
/// from outside the region, and Clang cannot return a vector from it.
#if defined(__clang__)
// A fragment may have no function of its own for a set.
#define ESPALIER_BEGIN_TARGET(features)                                                           \
    ESPALIER_PRAGMA(clang diagnostic push)                                                        \
    ESPALIER_PRAGMA(clang diagnostic ignored "-Wpragma-clang-attribute")                          \
    ESPALIER_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function)) \
    ESPALIER_PRAGMA(clang diagnostic pop)
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(clang attribute pop)
#else
// Silences -Wpsabi, because no function outside these regions takes or returns a vector.
#define ESPALIER_BEGIN_TARGET(features)               \
    ESPALIER_PRAGMA(GCC diagnostic push)              \
    ESPALIER_PRAGMA(GCC diagnostic ignored "-Wpsabi") \
    ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC target(features))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(GCC pop_options) ESPALIER_PRAGMA(GCC diagnostic pop)
#endif
/// Encloses code of instruction sets that few machines depend on, to be compiled at a level ("Os", "O2") that trades
/// speed for size. Clang has no such levels within a file, and builds that shall compile quickly define
/// ESPALIER_ONE_LEVEL.
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && !defined(__clang__) && !defined(ESPALIER_ONE_LEVEL)
#define ESPALIER_BEGIN_LEVEL(level) ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC optimize(level))
#define ESPALIER_END_LEVEL ESPALIER_PRAGMA(GCC pop_options)
#else
#define ESPALIER_BEGIN_LEVEL(level)
#define ESPALIER_END_LEVEL
#endif

#else  // another compiler, which can read only the public headers

#include <cstddef>

#if defined(_MSC_VER)
#define ESPALIER_NOINLINE __declspec(noinline)
#else
#define ESPALIER_NOINLINE
#endif
#define ESPALIER_COPY_BYTES(to, from, count) ::espalier::detail::copy_bytes(to, from, count)

namespace espalier::detail {

inline void copy_bytes(void* to, const void* from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) static_cast<std::byte*>(to)[i] = static_cast<const std::byte*>(from)[i];
}

}  // namespace espalier::detail

#endif
