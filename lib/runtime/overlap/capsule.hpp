// A capsule on the lattice.
#pragma once

#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <runtime/lattice/round_segment.hpp>
#include <runtime/overlap/volume.hpp>

namespace espalier::detail {

struct RoundedCapsule : Volume {
    RoundedSegment segment;
    float radius;  ///< lattice steps; 0 or at least 2^-100, may be infinite
    LatticePlane side_planes[6];
};

QueryStatus round_volume(const BlobData& blob, const Capsule& world, RoundedCapsule& capsule) noexcept;

/// Whether the triangle is within the radius of the segment, exactly.
[[nodiscard]] bool meets(const RoundedCapsule& capsule, const LatticeTriangle& triangle) noexcept;

}  // namespace espalier::detail
