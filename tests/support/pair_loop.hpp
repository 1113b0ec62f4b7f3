// The loop over all pairs of triangles of two blobs on their common grid: what every walk through two trees must equal.
#pragma once

#include <optional>
#include <vector>

#include <runtime/pair_queries.hpp>

#include "decoder.hpp"

namespace espalier::tests {

class PairLoop {
public:
    PairLoop(const detail::PairFrame& frame, const DecodedBlob& a, const DecodedBlob& b);

    /// Sorted. Triangles that are copies are left out.
    [[nodiscard]] std::vector<TrianglePair> every_contact() const;
    /// The least distance within the radius (steps of the grid); of equal ones the lowest pair.
    [[nodiscard]] std::optional<detail::FoundTriangles> nearest_pair(float radius) const;
    [[nodiscard]] bool is_any_within(float radius) const;

private:
    struct Placed {
        std::uint32_t index;
        detail::LatticeTriangle triangle;
        std::int32_t low[3], high[3];
    };
    template <class Place>
    static std::vector<Placed> placed(const DecodedBlob& blob, Place place);
    /// Squared, of the boxes.
    static double gap(const Placed& a, const Placed& b);

    std::vector<Placed> a_;
    std::vector<Placed> b_;
};

}  // namespace espalier::tests
