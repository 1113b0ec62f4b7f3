// Tests whether a bake made an open surface of a closed one.
#pragma once

#include <baker/input/source.hpp>
#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// Returns whether the source is closed and the baked surface is not. Reads BakeReport::closed and the counts of kept
/// and dropped triangles.
[[nodiscard]] bool has_lost_closed(const Source& source, const BakeReport& report);

/// Returns the fewest bits above `bits` with which a closed source stays closed; 0 if there are none. Snaps the source
/// once for each number that it tries.
[[nodiscard]] unsigned bits_that_keep_closed(const Source& source, const SourceBounds& bounds, unsigned bits);

}  // namespace espalier::baker
