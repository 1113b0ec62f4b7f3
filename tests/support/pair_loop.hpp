// The loop over all pairs of triangles of two blobs on their common grid: what every walk through two trees must equal.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include <runtime/pair_queries.hpp>

#include "decoder.hpp"
#include "triangle_bounds.hpp"

namespace espalier::tests {

/// Pairs whose boxes are farther apart than a query reaches need no kernel: so that real meshes can be asked too, boxes
/// around 32 triangles that follow each other, and around 32 of those, are compared first. No tree of the runtime's.
class PairLoop {
public:
    PairLoop(const detail::PairFrame& frame, const DecodedBlob& a, const DecodedBlob& b,
             LeftOut left_out = LeftOut::what_is_clear);

    /// Sorted. Triangles that are copies are left out.
    [[nodiscard]] std::vector<TrianglePair> every_contact() const;
    /// The least distance within the radius (steps of the grid); of equal ones the lowest pair.
    [[nodiscard]] std::optional<detail::FoundTriangles> nearest_pair(float radius) const;
    [[nodiscard]] bool is_any_within(float radius) const;

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::size_t group_size = 32;

    struct Box {
        double low[3] = {infinity, infinity, infinity};
        double high[3] = {-infinity, -infinity, -infinity};
        void extend(const double* place);
        void extend(const Box& other);
    };
    /// The triangles of one blob, and the boxes of each, of each group, and of each group of groups.
    struct Side {
        std::vector<std::uint32_t> indices;
        std::vector<detail::LatticeTriangle> triangles;
        std::array<std::vector<Box>, 3> boxes;
    };
    template <class Place>
    static Side placed(const DecodedBlob& blob, Place place);
    static double squared_gap(const Box& a, const Box& b);

    struct Near {
        double squared_gap;
        std::uint32_t a, b;
    };
    /// Boxes that are in the same box of the level above, or all of the highest, and not farther apart than that.
    void append_near(std::size_t level, const Near& parent, double limit, std::vector<Near>& near) const;
    /// Pairs of groups.
    [[nodiscard]] std::vector<Near> near_groups(double limit) const;

    LeftOut left_out_;
    Side a_;
    Side b_;
};

}  // namespace espalier::tests
