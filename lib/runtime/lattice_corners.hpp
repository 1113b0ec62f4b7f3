// A triangle that a query asks with, on the lattice.
#pragma once

#include <cstdint>

#include <espalier/status.hpp>
#include <espalier/types.hpp>
#include <runtime/triangle_triangle.hpp>
#include <runtime/volume.hpp>

namespace espalier::detail {

/// Also one without area.
struct LatticeCorners : Volume {
    int fraction_bits;         ///< 0..6
    IntegerTriangle triangle;  ///< in units of 2^-fraction_bits steps
    LatticePlane own_planes[5];
};

QueryStatus round_volume(const BlobData& blob, const Corners& world, LatticeCorners& corners) noexcept;

/// Whether the two triangles share a point, exactly.
[[nodiscard]] bool meets(const LatticeCorners& corners, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
