// Which optional sections this build of the runtime reads: a firmware links no more than its blobs need (the CMake
// option ESPALIER_SECTIONS). `open` refuses blobs that have others.
#pragma once

#include <cstdint>

#include <espalier/format.hpp>

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
