// What the library takes from a compiler beyond the C++ standard, under names of its own. GCC and Clang have all of it.
// c/attributes.h is the counterpart for C. For the library itself.
#pragma once

#if defined(__GNUC__) || defined(__clang__)  // which names itself alone in its Microsoft mode

/// For a function: it becomes a part of each caller. For a lambda, behind its parameters: the other one.
#define ESPALIER_ALWAYS_INLINE [[gnu::always_inline]]
#define ESPALIER_ALWAYS_INLINE_LAMBDA __attribute__((always_inline))
/// For a function: it has a frame of its own.
#define ESPALIER_NOINLINE [[gnu::noinline]]
/// For a function: it is called, and there is one copy of it.
#if defined(__clang__)
#define ESPALIER_ONE_COPY [[gnu::noinline]]
#else
#define ESPALIER_ONE_COPY [[gnu::noinline, gnu::noclone]]
#endif

/// Copies bytes, inline where the count is a constant. Neither needs a library.
#define ESPALIER_COPY_BYTES(to, from, count) __builtin_memcpy(to, from, count)
#define ESPALIER_MOVE_BYTES(to, from, count) __builtin_memmove(to, from, count)
#define ESPALIER_PREFETCH(at) __builtin_prefetch(at)
/// Returns a number without its sign, or its square root: one instruction, where the machine has it.
#define ESPALIER_ABSOLUTE(x) __builtin_fabsf(x)
#define ESPALIER_SQUARE_ROOT(x) __builtin_sqrtf(x)

/// For a type of vectors: `using Four ESPALIER_VECTOR_BYTES(16) = float`. Operators work on all elements.
#define ESPALIER_VECTOR_BYTES(bytes) [[gnu::vector_size(bytes)]]
/// Returns a vector with each element converted, or with elements of one or two vectors by their numbers.
#define ESPALIER_CONVERT_VECTOR(vector, To) __builtin_convertvector(vector, To)
#define ESPALIER_SHUFFLE_VECTOR(...) __builtin_shufflevector(__VA_ARGS__)
#if defined(__SSE2__)
/// Returns two vectors of four integers as one of eight of 16 bits, saturated.
#define ESPALIER_PACK_SATURATED(a, b) __builtin_ia32_packssdw128(a, b)
#endif

/// Hides the value from the optimiser, so that nothing which depends on it is hoisted out of a loop. The place is the
/// letter of a kind of register: "r" is general.
#define ESPALIER_AS_IF_CHANGED(x, place) __asm__ volatile("" : "+" place(x))

#if defined(__SIZEOF_INT128__)
namespace espalier::detail {

__extension__ using NativeInt128 = __int128;
__extension__ using NativeUnsignedInt128 = unsigned __int128;

}  // namespace espalier::detail
#endif

#define ESPALIER_PRAGMA(text) _Pragma(#text)
/// Around code that GCC warns about, because it finds no proof that a variable has a value.
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
/// Around code for the instructions of a list of features. Regions of a file are marked so, and no flags are given for
/// whole files: flags would leak wide instructions into inline functions that other files share. Include every header
/// before a region begins. Vectors are reinterpreted by __builtin_bit_cast there: std::bit_cast is a function from
/// outside, and Clang returns none of them from it.
#if defined(__clang__)
#define ESPALIER_BEGIN_TARGET(features) \
    ESPALIER_PRAGMA(clang attribute push(__attribute__((target(features))), apply_to = function))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(clang attribute pop)
#else
// Without -Wpsabi: no function outside of these regions takes or returns a vector.
#define ESPALIER_BEGIN_TARGET(features)               \
    ESPALIER_PRAGMA(GCC diagnostic ignored "-Wpsabi") \
    ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC target(features))
#define ESPALIER_END_TARGET ESPALIER_PRAGMA(GCC pop_options)
#endif
/// Around code that may be slower if it is smaller ("Os", "O2"), of instruction sets that few machines are left with.
/// Clang has no such levels within a file.
#if defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__) && !defined(__clang__)
#define ESPALIER_BEGIN_LEVEL(level) ESPALIER_PRAGMA(GCC push_options) ESPALIER_PRAGMA(GCC optimize(level))
#define ESPALIER_END_LEVEL ESPALIER_PRAGMA(GCC pop_options)
#else
#define ESPALIER_BEGIN_LEVEL(level)
#define ESPALIER_END_LEVEL
#endif

#else  // a compiler that reads the public headers alone

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
