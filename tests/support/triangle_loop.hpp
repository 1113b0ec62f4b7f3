// The loop over all baked triangles: what every traversal must equal, bit for bit. It asks the runtime's kernels about
// each triangle that the independent decoder found, in storage order, and knows no tree.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <espalier/blob.hpp>
#include <runtime/closest_pair.hpp>
#include <runtime/found.hpp>
#include <runtime/volume.hpp>
#include <runtime/winding.hpp>

#include "decoder.hpp"

namespace espalier::tests {

class TriangleLoop {
public:
    explicit TriangleLoop(const DecodedBlob& decoded);

    /// In storage order.
    [[nodiscard]] std::vector<detail::FoundHit> every_hit(const detail::LatticeRay& ray) const;
    [[nodiscard]] std::vector<std::uint32_t> every_overlap(const detail::LatticePoint& point) const;
    /// Of a volume that was rounded and is not empty.
    [[nodiscard]] std::vector<std::uint32_t> every_overlap(const detail::Volume& volume) const;
    /// All within the radius, sorted by distance and index.
    [[nodiscard]] std::vector<detail::FoundNearest> by_distance(const detail::LatticePoint& point) const;
    [[nodiscard]] std::optional<detail::FoundPair> closest_pair(const detail::DistantShape& shape) const;
    /// Along the ray's direction.
    [[nodiscard]] detail::Winding winding(const detail::WindingRay& ray) const;

private:
    std::vector<detail::LatticeTriangle> triangles_;
    std::vector<std::uint32_t> owners_;  // copies are no triangles of their own
};

}  // namespace espalier::tests
