// A box of any orientation on the lattice, sheared and flat ones too, and whether a triangle overlaps it: separating
// axes in integers (Gottschalk, Lin and Manocha 1996), completed for shapes without volume (docs/numerics.md).
#pragma once

#include <cstdint>

#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

/// All points center + a * half[0] + b * half[1] + c * half[2] with a, b, c in [-1, 1].
template <>
struct Rounded<OrientedBox> : VolumeOf<OrientedBox, 6> {
    int fraction_bits;  ///< 0..6; what follows is in units of 2^-fraction_bits steps
    Integer3 center;
    Integer3 half[3];
    bool is_near;  ///< center and half axes stay below 2^23, seen from any vertex of the asset and added up

    WideVector face[3];  ///< normals of the faces: products of two half axes
    Int128 face_reach;   ///< how far each face is along its normal; zero for a flat box
};

QueryStatus round_volume(const BlobData& blob, const OrientedBox& world, Rounded<OrientedBox>& box) noexcept;

/// Whether the triangle and the box share a point, exactly.
[[nodiscard]] bool meets(const Rounded<OrientedBox>& box, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
