// Whether a bake made an open surface of a closed one.
#pragma once

#include <baker/input/source.hpp>
#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// Fills in BakeReport::lost_closed and bits_that_keep_closed. Reads BakeReport::closed, bits and the counts of kept
/// and dropped triangles. Snaps the source once for each number of bits that it tries, and only if `closed` is lost.
void report_lost_closed(const Source& source, const SourceBounds& bounds, BakeReport& report);

}  // namespace espalier::baker
