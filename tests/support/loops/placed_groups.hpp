// The triangles of a blob in groups, and where a placement puts them on the grid of two blobs. Only what is asked for
// is placed: against a small mesh most of a large one never is. No tree, and nothing that the runtime culls with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <runtime/pairs/frame.hpp>

#include "support/format/decoder.hpp"

namespace espalier::tests {

/// What does not depend on a placement: 32 triangles that follow each other are a group, 32 groups a block.
struct TriangleGroups {
    explicit TriangleGroups(const DecodedBlob& decoded);

    static constexpr std::size_t group_size = 32;
    static std::size_t count(std::size_t members) { return (members + group_size - 1) / group_size; }

    struct LatticeRange {
        GridPoint low, high;
    };
    std::vector<std::uint32_t> indices;  ///< without those of copies
    std::vector<detail::LatticeTriangle> triangles;
    std::vector<LatticeRange> groups, blocks;
};

/// On the grid.
struct PlacedBox {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    double low[3] = {infinity, infinity, infinity};
    double high[3] = {-infinity, -infinity, -infinity};
    void extend(const std::int32_t* place);
};
double squared_gap(const PlacedBox& a, const PlacedBox& b);

struct PlacedTriangle {
    PlacedTriangle(const detail::LatticeTriangle& triangle, std::uint32_t storage_index);

    PlacedBox box;
    detail::LatticeTriangle at;
    std::uint32_t index;  ///< in storage order
    double normal[3];     ///< of length 1, or 0 where rounding left no area
    double offset;        ///< of the plane
};
/// How far the box or the triangle is from the other one's plane at least, squared; 0 where it may reach it. A box is
/// far from most planes of a large triangle that is inside that triangle's own box.
double squared_gap_to_plane(const PlacedTriangle& of_plane, const PlacedBox& box);
double squared_gap_to_plane(const PlacedTriangle& of_plane, const PlacedTriangle& other);

class PlacedGroups {
public:
    enum class Side { a, b };
    /// Both must outlive this.
    PlacedGroups(const TriangleGroups& groups, const detail::PairFrame& frame, Side side);

    [[nodiscard]] const std::vector<PlacedBox>& blocks() const { return blocks_; }
    /// Which begin with group `block` * 32; around more than their triangles.
    [[nodiscard]] const std::vector<PlacedBox>& groups_of(std::size_t block) const;
    [[nodiscard]] const std::vector<PlacedTriangle>& triangles_of(std::size_t group) const;

    struct GridPlace {
        std::int32_t axis[3];
    };
    /// Of some triangle.
    [[nodiscard]] GridPlace corner_in_group(std::size_t group) const;

private:
    void place(const std::int32_t* from, std::int32_t* to) const;
    [[nodiscard]] PlacedBox placed(const TriangleGroups::LatticeRange& range) const;

    const TriangleGroups& own_;
    const detail::PairFrame& frame_;
    Side side_;
    std::vector<PlacedBox> blocks_;
    mutable std::vector<std::vector<PlacedBox>> groups_;          // of each block; empty until it is asked for
    mutable std::vector<std::vector<PlacedTriangle>> triangles_;  // of each group, likewise
};

}  // namespace espalier::tests
