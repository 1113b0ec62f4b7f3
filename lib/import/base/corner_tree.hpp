// Corners of a polygon by where they lie.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace espalier::importer {

using PlanePoint = std::array<double, 2>;

/// Twice the area of a triangle; positive if its corners run counter-clockwise.
inline double plane_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Finds a corner inside of a triangle. Which corners count changes as a polygon is cut.
class CornerTree {
public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// Takes all points, of which no corner counts yet. They must outlive it.
    void build(const std::vector<PlanePoint>& points);
    void set_counts(std::uint32_t corner, bool counts);
    [[nodiscard]] bool counts(std::uint32_t corner) const { return counts_[corner] != 0; }
    /// Returns a corner that counts and lies in the triangle or on its sides, but in none of its own corners; `none`
    /// without one. Adds to `steps` how many boxes and corners it looked at.
    [[nodiscard]] std::uint32_t find_inside(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c,
                                            std::uint64_t& steps) const;

private:
    struct Box {
        PlanePoint low, high;
    };
    /// A range of `order_`. Nodes are numbered as in a heap: 2i + 1 and 2i + 2 are below i.
    struct Node {
        Box box;  ///< around the corners that count, and those that did
        std::uint32_t begin, end;
        std::uint32_t counting;  ///< how many of its corners count
    };

    [[nodiscard]] static Box box_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c);
    static void grow(Box& box, const PlanePoint& point);
    void split(std::size_t node, std::uint32_t begin, std::uint32_t end);

    const std::vector<PlanePoint>* points_ = nullptr;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;   // the corners, leaf by leaf
    std::vector<std::uint32_t> leaves_;  // the leaf of each corner
    std::vector<char> counts_;
    mutable std::vector<std::uint32_t> open_;
};

}  // namespace espalier::importer
