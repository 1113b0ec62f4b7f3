// Closed blobs, and points whose ways out of them are hard to count.
#pragma once

#include <optional>
#include <vector>

#include <runtime/proximity/winding.hpp>

#include "support/base/random.hpp"
#include "support/blobs/test_blobs.hpp"

namespace espalier::tests {

/// Closed blobs: of one shell and of several, nested, overlapping, inside out, touching in many lattice points.
const std::vector<TestBlob>& closed_blobs();

/// Points whose ways out meet corners, sides and faces: coordinates of vertices and of the middles of sides, together
/// and mixed.
Vec3 awkward_point(const TestBlob& blob, Random& random);
/// In the asset's box or just beside it.
Vec3 random_point(const TestBlob& blob, Random& random);

/// Where the asset's box does not hold the point nothing winds around it.
std::optional<detail::WindingRay> shortest_way_out(const Blob& blob, Vec3 point);

}  // namespace espalier::tests
