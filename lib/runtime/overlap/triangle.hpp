// A triangle as the shape of a query, on the lattice.
#pragma once

#include <cstdint>

#include <espalier/status.hpp>
#include <espalier/types.hpp>
#include <runtime/kernels/triangle_triangle.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

/// Also one without area.
struct RoundedTriangle : Volume {
    int fraction_bits;         ///< 0..6
    IntegerTriangle triangle;  ///< in units of 2^-fraction_bits steps
    LatticePlane own_planes[5];
};

QueryStatus round_volume(const BlobData& blob, const Triangle& world, RoundedTriangle& corners) noexcept;

/// Whether the two triangles share a point, exactly.
[[nodiscard]] bool meets(const RoundedTriangle& corners, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
