// A capsule on the lattice.
#pragma once

#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

template <>
struct Rounded<Capsule> : VolumeOf<Capsule, 6> {
    RoundedSegment segment;
    float radius;  ///< lattice steps; 0 or at least 2^-100, may be infinite
};

QueryStatus round_volume(const BlobData& blob, const Capsule& world, Rounded<Capsule>& capsule) noexcept;

/// Whether the triangle is within the radius of the segment, exactly.
[[nodiscard]] bool meets(const Rounded<Capsule>& capsule, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
