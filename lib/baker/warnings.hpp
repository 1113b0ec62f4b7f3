// The warnings of a bake.
#pragma once

#include <cstdint>

#include <espalier/bake.hpp>

#include <baker/input/source.hpp>
#include <baker/quantise/lattice.hpp>

namespace espalier::baker {

/// Which tests are made: looking for the bits that keep a surface closed may take as long as the bake.
enum class LostClosed : std::uint8_t { left_out, tested };

/// Fills in BakeReport::warnings and bits_that_keep_closed. All other fields of the report are filled in already.
void add_warnings(const Source& source, const SourceBounds& bounds, const Lattice& lattice, LostClosed lost_closed,
                  BakeReport& report);

}  // namespace espalier::baker
