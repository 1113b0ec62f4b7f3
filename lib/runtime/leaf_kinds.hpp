// Which kinds of leaves this build of the runtime reads: a firmware links no more than its blobs need (the CMake option
// ESPALIER_PROFILES). `open` refuses the others.
#pragma once

#include <espalier/format.hpp>
#include <runtime/codec_plain.hpp>
#include <runtime/codec_strip.hpp>

#ifndef ESPALIER_PLAIN_LEAVES
#define ESPALIER_PLAIN_LEAVES 1
#endif
#ifndef ESPALIER_STRIP_LEAVES
#define ESPALIER_STRIP_LEAVES 1
#endif

/// Before what exists once for each kind of leaf: a function of its own where there are several kinds, so that a frame
/// on the stack holds but one of them, and part of its caller elsewhere.
#if ESPALIER_PLAIN_LEAVES && ESPALIER_STRIP_LEAVES
#define ESPALIER_FOR_ONE_KIND_OF_LEAF [[gnu::noinline]]
#else
#define ESPALIER_FOR_ONE_KIND_OF_LEAF [[gnu::always_inline]]
#endif

namespace espalier::detail {

inline constexpr bool reads_plain_leaves = ESPALIER_PLAIN_LEAVES != 0;
inline constexpr bool reads_strip_leaves = ESPALIER_STRIP_LEAVES != 0;
static_assert(reads_plain_leaves || reads_strip_leaves, "a runtime that reads no profile is of no use");

constexpr bool is_read(format::Profile profile) {
    return profile == format::Profile::fast ? reads_plain_leaves : reads_strip_leaves;
}
/// Of a profile that is read.
constexpr bool has_plain_leaves(format::Profile profile) {
    return !reads_strip_leaves || (reads_plain_leaves && profile == format::Profile::fast);
}

}  // namespace espalier::detail
