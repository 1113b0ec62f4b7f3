// The options of a build: the profiles and sections that it reads, the steps that it counts, and the policy for small
// cores.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <espalier/base/compiler.hpp>
#include <espalier/format.hpp>
#include <espalier/base/function_ref.hpp>

// The policy for small cores: microcontrollers (Cortex-M), whose flash holds a program and its blobs. They give the
// same answers with less code and stack. Code chooses between its two forms by the macros, constants and functions of
// this file, and by `small_code` where none of them fits. The CMake option ESPALIER_SMALL_CODE sets the policy for any
// machine, as tests do.

namespace espalier::detail {

// What keeps a compiler from fetching ahead or in pieces.

/// Hides a pointer or number from the optimiser, so that loads are not hoisted out of the loop and spilled: what they
/// load is in the cache anyway. A word that is loaded also stays one word.
template <class T>
ESPALIER_ALWAYS_INLINE inline T as_if_changed(T x) {
    ESPALIER_AS_IF_CHANGED(x, "r");
    return x;
}

}  // namespace espalier::detail

#ifndef ESPALIER_SMALL_CODE
#if defined(__ARM_ARCH_PROFILE) && __ARM_ARCH_PROFILE == 'M'
#define ESPALIER_SMALL_CODE 1
#else
#define ESPALIER_SMALL_CODE 0
#endif
#endif

// The instruction sets that are compiled in addition to the scalar one: none in small code.
#if (defined(__x86_64__) || (defined(__i386__) && defined(__SSE2__))) && !ESPALIER_SMALL_CODE
#define ESPALIER_X86 1
#else
#define ESPALIER_X86 0
#endif
// Which of those of x86, 1 or 0. AVX-512 takes parts of AVX2.
#ifndef ESPALIER_SET_SSE42
#define ESPALIER_SET_SSE42 1
#endif
#ifndef ESPALIER_SET_AVX2
#define ESPALIER_SET_AVX2 1
#endif
#ifndef ESPALIER_SET_AVX512
#define ESPALIER_SET_AVX512 ESPALIER_SET_AVX2
#endif
#if ESPALIER_SET_AVX512 && !ESPALIER_SET_AVX2
#error "ESPALIER_SET_AVX512=1 needs ESPALIER_SET_AVX2=1"
#endif
#if defined(__aarch64__) && defined(__ARM_NEON) && !defined(__AARCH64EB__) && !ESPALIER_SMALL_CODE
#define ESPALIER_NEON 1
#else
#define ESPALIER_NEON 0
#endif
#if defined(__wasm_simd128__) && !ESPALIER_SMALL_CODE
#define ESPALIER_SIMD128 1  // WebAssembly's
#else
#define ESPALIER_SIMD128 0
#endif
// Precedes the queries that each set defines. The single file sets it to `inline`, so that the compiler leaves out
// those that nothing calls; elsewhere the linker does.
#ifndef ESPALIER_QUERY_OF_SET
#define ESPALIER_QUERY_OF_SET
#endif
// Whether the scalar set is compiled to be fast. It is the only one of some machines. Those of x86 run it where they
// have none of the others: there it is small, and single rays are answered by the code of small cores.
#ifndef ESPALIER_FAST_SCALAR
#if ESPALIER_X86 || ESPALIER_SMALL_CODE
#define ESPALIER_FAST_SCALAR 0
#else
#define ESPALIER_FAST_SCALAR 1
#endif
#endif
// Whether integers of 128 bits are the compiler's. Small code shares functions of its own.
#if defined(__SIZEOF_INT128__) && !ESPALIER_SMALL_CODE
#define ESPALIER_NATIVE_INT128 1
#else
#define ESPALIER_NATIVE_INT128 0
#endif

/// For a small function with many callers: an inlined copy takes several times the code of a call.
#if ESPALIER_SMALL_CODE
#define ESPALIER_SHARED_CODE ESPALIER_ONE_COPY
/// For a larger function with one caller: inlined, it saves the call.
#define ESPALIER_PART_OF_CALLER ESPALIER_ALWAYS_INLINE
/// For a function that fast code inlines into each caller, so that it is compiled for the caller's instruction set.
#define ESPALIER_SHARED_OR_PART_OF_CALLER ESPALIER_NOINLINE
#else
#define ESPALIER_SHARED_CODE
#define ESPALIER_PART_OF_CALLER
#define ESPALIER_SHARED_OR_PART_OF_CALLER ESPALIER_ALWAYS_INLINE
#endif

namespace espalier::detail {

inline constexpr bool small_code = ESPALIER_SMALL_CODE != 0;
inline constexpr bool has_fast_scalar = ESPALIER_FAST_SCALAR != 0;

/// The queries of one ray where there are no lanes. Small cores have a walk of their own, almost without floats.
namespace scalar {}
namespace small {}
#if ESPALIER_FAST_SCALAR
namespace single_rays = scalar;
#else
namespace single_rays = small;
#endif

/// The alignment of data that one vector register, or two, load at once. Small cores have none and save the stack.
inline constexpr std::size_t register_alignment = small_code ? 4 : 16;
inline constexpr std::size_t wide_register_alignment = small_code ? 4 : 32;

/// Returns whether to take a shortcut that applies: a second form, faster than the general one and with the same
/// result. Small code has only the general form. A condition that takes more than a comparison is written behind the
/// call, by &&: small code then does not compute it.
ESPALIER_ALWAYS_INLINE constexpr bool takes_shortcut(bool applies = true) { return !small_code && applies; }

/// The numbers to use where narrow ones suffice. Small code has the functions of the wide ones in any case.
template <class Narrow, class Wide>
using SufficientNumber = std::conditional_t<small_code, Wide, Narrow>;

/// How functions that are not inlined take numbers: in registers, or by reference where registers are few.
template <class Number>
using Argument = std::conditional_t<small_code && (sizeof(Number) > 8), const Number&, Number>;

/// How functions with many callers take a callable. Small code has one copy of such a function for all callables.
template <class Function, class Signature>
using Callable = std::conditional_t<small_code, FunctionRef<Signature>, Function>;

/// Returns the same object. Small cores load it again, because what compilers keep of it in registers takes stack.
template <class T>
ESPALIER_ALWAYS_INLINE inline const T& load_again(const T& x) {
    if constexpr (small_code) return *as_if_changed(&x);
    else return x;
}

/// Returns the number of bits that are set. Small cores have no instruction for it, and the compiler's function is
/// larger.
inline std::uint32_t count_bits(std::uint32_t word) {
    if constexpr (!small_code) return static_cast<std::uint32_t>(std::popcount(word));
    std::uint32_t count = 0;
    for (; word != 0; word &= word - 1) ++count;
    return count;
}

/// The same. For the oldest processors of x86 compilers call a function, in these few lines too they have an
/// instruction for the others.
inline std::uint32_t count_bits(std::uint64_t word) {
    if constexpr (!ESPALIER_X86) return static_cast<std::uint32_t>(std::popcount(word));
    word -= word >> 1 & 0x5555555555555555u;
    word = (word & 0x3333333333333333u) + (word >> 2 & 0x3333333333333333u);
    word = (word + (word >> 4)) & 0x0F0F0F0F0F0F0F0Fu;
    return static_cast<std::uint32_t>(word * 0x0101010101010101u >> 56);
}

}  // namespace espalier::detail

// The profiles and optional sections that this build reads: a firmware links no more than its blobs need (the CMake
// options ESPALIER_PROFILES and ESPALIER_SECTIONS). `open` refuses other blobs.

#ifndef ESPALIER_PLAIN_LEAVES
#define ESPALIER_PLAIN_LEAVES 1
#endif
#ifndef ESPALIER_STRIP_LEAVES
#define ESPALIER_STRIP_LEAVES 1
#endif
#ifndef ESPALIER_PREDICTED_STRIPS
#define ESPALIER_PREDICTED_STRIPS 1
#endif

/// Before what exists once for each kind of leaf: a function of its own where there are several kinds, so that a frame
/// on the stack holds but one of them, and part of its caller elsewhere.
#if ESPALIER_PLAIN_LEAVES && (ESPALIER_STRIP_LEAVES || ESPALIER_PREDICTED_STRIPS)
#define ESPALIER_FOR_ONE_KIND_OF_LEAF ESPALIER_NOINLINE
#else
#define ESPALIER_FOR_ONE_KIND_OF_LEAF ESPALIER_ALWAYS_INLINE
#endif

namespace espalier::detail {

inline constexpr bool reads_plain_leaves = ESPALIER_PLAIN_LEAVES != 0;
/// Strips whose vertices are stored: profiles balanced and small.
inline constexpr bool reads_stored_strips = ESPALIER_STRIP_LEAVES != 0;
/// Strips whose vertices are predicted: profile tiny.
inline constexpr bool reads_predicted_strips = ESPALIER_PREDICTED_STRIPS != 0;
inline constexpr bool reads_strip_leaves = reads_stored_strips || reads_predicted_strips;
static_assert(reads_plain_leaves || reads_strip_leaves, "a runtime that reads no profile is of no use");

constexpr bool is_read(Profile profile) {
    if (profile == Profile::fast) return reads_plain_leaves;
    return format::has_predicted_strips(profile) ? reads_predicted_strips : reads_stored_strips;
}
/// Returns whether a profile that this build reads has plain leaves.
constexpr bool has_plain_leaves(Profile profile) {
    return !reads_strip_leaves || (reads_plain_leaves && profile == Profile::fast);
}
/// Returns whether a profile that this build reads, and that has strips, predicts their vertices.
constexpr bool has_predicted_leaves(Profile profile) {
    return reads_predicted_strips && (!reads_stored_strips || format::has_predicted_strips(profile));
}

}  // namespace espalier::detail

#ifndef ESPALIER_IDS
#define ESPALIER_IDS 1
#endif
#ifndef ESPALIER_MATERIALS
#define ESPALIER_MATERIALS 1
#endif
#ifndef ESPALIER_COPIES
#define ESPALIER_COPIES 1
#endif
#ifndef ESPALIER_EDGES
#define ESPALIER_EDGES 1
#endif
#ifndef ESPALIER_BOUNDS
#define ESPALIER_BOUNDS 1
#endif
#ifndef ESPALIER_DEFORMATION
#define ESPALIER_DEFORMATION 1
#endif

namespace espalier::detail {

/// What a blob's features field may have.
inline constexpr std::uint32_t read_features =
    format::feature::known &
    ~((ESPALIER_IDS ? 0 : format::feature::original_ids | format::feature::id_runs) |
      (ESPALIER_MATERIALS ? 0 : format::feature::materials_8 | format::feature::materials_16) |
      (ESPALIER_COPIES ? 0 : format::feature::split_references) | (ESPALIER_EDGES ? 0 : format::feature::edge_flags) |
      (ESPALIER_BOUNDS ? 0 : format::feature::bounds) |
      (ESPALIER_DEFORMATION && reads_plain_leaves ? 0 : format::feature::deformable));

/// Whether any of these is read.
constexpr bool reads(std::uint32_t features) { return (read_features & features) != 0; }

}  // namespace espalier::detail

// Counts the work of walks in builds with the CMake option ESPALIER_COUNT_STEPS, so that tests can hold every query to
// the bound that it states. In other builds nothing is counted and no code is made.

#ifndef ESPALIER_COUNT_STEPS
#define ESPALIER_COUNT_STEPS 0
#endif

namespace espalier::detail {

#if ESPALIER_COUNT_STEPS

struct StepCounter {
    std::uint64_t nodes = 0;   ///< tests of a node's children, by one ray, shape or box
    std::uint64_t leaves = 0;  ///< visits of a leaf
    /// Triangles that lanes and bounds left open, decided by the exact kernels of rays, points and volumes.
    std::uint64_t decisions = 0;
    /// Axes along which boxes of two blobs were looked at, those of a vector register at once; in small code also those
    /// across a ray along which a box was.
    std::uint64_t axes = 0;
};
inline thread_local constinit StepCounter step_counter;

inline void count_node_step() { ++step_counter.nodes; }
inline void count_leaf_step() { ++step_counter.leaves; }
inline void count_decision() { ++step_counter.decisions; }
inline void count_axes(unsigned axes) { step_counter.axes += axes; }

#else

constexpr void count_node_step() {}
constexpr void count_leaf_step() {}
constexpr void count_decision() {}
constexpr void count_axes(unsigned) {}

#endif

}  // namespace espalier::detail
