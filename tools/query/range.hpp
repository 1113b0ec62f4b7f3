// The values that queries accept for their arguments.
#pragma once

#include <cstdint>
#include <span>

namespace espalier::tools {

/// The values of an argument that a query accepts; it refuses others as invalid.
enum class Range : std::uint8_t {
    finite,
    number,       ///< infinite ones too
    size,         ///< from 0 on, or infinite
    finite_size,  ///< from 0 on
    direction,    ///< finite, and not of length zero
    apart,        ///< finite, and another point than the argument before
    factor,       ///< finite and above 0
};

/// Returns whether the coordinates of an argument are in the range, but for lengths that round to zero.
bool holds(Range range, std::span<const double> values);

/// Returns the words after "it must be".
const char* describe(Range range);

}  // namespace espalier::tools
