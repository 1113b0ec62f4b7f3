// Which profiles this build of the runtime reads: a firmware links no more than its blobs need (the CMake option
// ESPALIER_PROFILES). `open` refuses the others.
#pragma once

#include <espalier/format.hpp>

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
#define ESPALIER_FOR_ONE_KIND_OF_LEAF [[gnu::noinline]]
#else
#define ESPALIER_FOR_ONE_KIND_OF_LEAF [[gnu::always_inline]]
#endif

namespace espalier::detail {

inline constexpr bool reads_plain_leaves = ESPALIER_PLAIN_LEAVES != 0;
/// Strips whose vertices are stored: profiles balanced and small.
inline constexpr bool reads_stored_strips = ESPALIER_STRIP_LEAVES != 0;
/// Strips whose vertices are predicted: profile tiny.
inline constexpr bool reads_predicted_strips = ESPALIER_PREDICTED_STRIPS != 0;
inline constexpr bool reads_strip_leaves = reads_stored_strips || reads_predicted_strips;
static_assert(reads_plain_leaves || reads_strip_leaves, "a runtime that reads no profile is of no use");

constexpr bool is_read(format::Profile profile) {
    if (profile == format::Profile::fast) return reads_plain_leaves;
    return format::has_predicted_strips(profile) ? reads_predicted_strips : reads_stored_strips;
}
/// Of a profile that is read.
constexpr bool has_plain_leaves(format::Profile profile) {
    return !reads_strip_leaves || (reads_plain_leaves && profile == format::Profile::fast);
}
/// Of a profile that is read and has strips.
constexpr bool has_predicted_leaves(format::Profile profile) {
    return reads_predicted_strips && (!reads_stored_strips || format::has_predicted_strips(profile));
}

}  // namespace espalier::detail
