// Which profiles and optional sections this build of the runtime reads: a firmware links no more than its blobs need
// (the CMake options ESPALIER_PROFILES and ESPALIER_SECTIONS). `open` refuses other blobs.
#pragma once

#include <cstdint>

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

constexpr bool is_read(Profile profile) {
    if (profile == Profile::fast) return reads_plain_leaves;
    return format::has_predicted_strips(profile) ? reads_predicted_strips : reads_stored_strips;
}
/// Of a profile that is read.
constexpr bool has_plain_leaves(Profile profile) {
    return !reads_strip_leaves || (reads_plain_leaves && profile == Profile::fast);
}
/// Of a profile that is read and has strips.
constexpr bool has_predicted_leaves(Profile profile) {
    return reads_predicted_strips && (!reads_stored_strips || format::has_predicted_strips(profile));
}

}  // namespace espalier::detail

// The optional sections.

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

namespace espalier::detail {

/// What a blob's features field may have.
inline constexpr std::uint32_t read_features =
    format::feature::known &
    ~((ESPALIER_IDS ? 0 : format::feature::original_ids) |
      (ESPALIER_MATERIALS ? 0 : format::feature::materials_8 | format::feature::materials_16) |
      (ESPALIER_COPIES ? 0 : format::feature::split_references) | (ESPALIER_EDGES ? 0 : format::feature::edge_flags) |
      (ESPALIER_BOUNDS ? 0 : format::feature::bounds));

/// Whether any of these is read.
constexpr bool reads(std::uint32_t features) { return (read_features & features) != 0; }

}  // namespace espalier::detail
