// A triangle as the shape of a query, on the lattice.
#pragma once

#include <cstdint>

#include <espalier/status.hpp>
#include <espalier/types.hpp>
#include <runtime/kernels/triangle_triangle.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

/// Also one without area.
template <>
struct Rounded<Triangle> : VolumeOf<Triangle, 5> {
    int fraction_bits;         ///< 0..6
    IntegerTriangle triangle;  ///< in units of 2^-fraction_bits steps
};

QueryStatus round_volume(const BlobData& blob, const Triangle& world, Rounded<Triangle>& corners) noexcept;

/// Whether the two triangles share a point, exactly.
[[nodiscard]] bool meets(const Rounded<Triangle>& corners, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
