// An axis-aligned box on the lattice, and whether a triangle overlaps it: thirteen possible separating axes, in
// integers (Akenine-Möller 2001 has them for floats).
#pragma once

#include <cstdint>

#include <espalier/lattice.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

/// In units of 2^-7 steps: sums and differences of coordinates that are multiples of 2^-6.
template <>
struct Rounded<Box> : VolumeOf<Box, 0> {
    static constexpr int fraction_bits = 7;

    std::int64_t center[3];
    std::int64_t half[3];  ///< >= 0
};

QueryStatus round_volume(const BlobData& blob, const Box& world, Rounded<Box>& box) noexcept;

template <>
struct Rounded<LatticeBox> : Rounded<Box> {};
/// Moves the box onto the grid, which rounds nothing.
QueryStatus round_volume(const BlobData& blob, const LatticeBox& steps, Rounded<Box>& box) noexcept;

/// Whether the triangle and the box share a point, exactly.
[[nodiscard]] bool meets(const Rounded<Box>& box, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
