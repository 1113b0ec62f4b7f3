// A convex set of half-spaces on the lattice, bounded or not, and whether a triangle reaches into all of them at once.
#pragma once

#include <cstdint>

#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

/// Normals whose largest coordinate is in [2^23, 2^24]; offsets within 2^52.
template <>
struct Rounded<ConvexVolume> : VolumeOf<ConvexVolume, max_planes> {};

QueryStatus round_volume(const BlobData& blob, const ConvexVolume& world, Rounded<ConvexVolume>& set) noexcept;

/// Whether some point of the triangle is in all half-spaces, exactly.
[[nodiscard]] bool meets(const Rounded<ConvexVolume>& set, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
