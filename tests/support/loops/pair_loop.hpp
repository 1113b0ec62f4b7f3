// The loop over all pairs of triangles of two blobs on their common grid: what every walk through two trees must equal.
#pragma once

#include <vector>

#include <runtime/pairs/queries.hpp>

#include "placed_groups.hpp"
#include "triangle_bounds.hpp"

namespace espalier::tests {

/// The first of those that `nearest_pairs` found that is within the radius (steps of the grid, and near the least
/// distance); a null pointer when none is.
const detail::FoundTriangles* first_within(const std::vector<detail::FoundTriangles>& nearest, float radius);

/// Pairs whose boxes are farther apart than a query reaches need no kernel, nor do those that a plane of one of them
/// keeps as far apart: so that real meshes can be asked too, boxes around groups of triangles, and around blocks of
/// groups, are compared first.
class PairLoop {
public:
    /// All must outlive this.
    PairLoop(const detail::PairFrame& frame, const TriangleGroups& a, const TriangleGroups& b,
             LeftOut left_out = LeftOut::what_is_clear);

    /// Sorted. Triangles that are copies are left out.
    [[nodiscard]] std::vector<detail::TrianglePair> every_contact() const;
    /// The pair at the least distance, of equal ones the lowest, and then, sorted too, those so little farther away
    /// that an exact look at them may say otherwise. None in empty blobs.
    [[nodiscard]] std::vector<detail::FoundTriangles> nearest_pairs() const;
    /// Steps of the grid.
    [[nodiscard]] bool is_any_within(float radius) const;

private:
    struct Near {
        double squared_gap;
        std::size_t a, b;
    };
    [[nodiscard]] bool is_clear(double squared_gap, double limit) const {
        return squared_gap > limit && left_out_ != LeftOut::nothing;
    }
    /// Pairs of blocks, the nearest first.
    [[nodiscard]] std::vector<Near> near_blocks(double limit) const;
    /// Appends pairs of groups.
    void append_near(const Near& blocks, double limit, std::vector<Near>& groups) const;
    /// `visit` takes two triangles, and says whether to go on. It may lower the limit.
    template <class Visit>
    bool visit_near(const Near& groups, const double& limit, Visit visit) const;
    [[nodiscard]] double squared_between_corners(const Near& groups) const;

    LeftOut left_out_;
    PlacedGroups a_;
    PlacedGroups b_;
};

}  // namespace espalier::tests
