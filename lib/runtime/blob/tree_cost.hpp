// The cost of a tree of plain nodes for an average ray, by the surface area heuristic (Goldsmith and Salmon 1987).
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/node.hpp>

namespace espalier::detail {

/// Returns half the surface of a box whose sides are counted in units, both ends included.
ESPALIER_ALWAYS_INLINE inline float half_area_of_sides(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto side = [](std::uint32_t units) { return static_cast<float>(static_cast<std::int32_t>(units)); };
    const float a = side(x), b = side(y), c = side(z);
    return (a * b + b * c) + c * a;
}

/// The planes around some children of a node, in units.
struct PlaneBox {
    std::uint32_t low[3] = {0xFFFF, 0xFFFF, 0xFFFF};
    std::uint32_t high[3] = {0, 0, 0};

    [[nodiscard]] float half_area() const {
        return half_area_of_sides(high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1);
    }
};

/// The areas of the boxes of a tree, added node by node from the last to the first: on every machine in one order.
struct TreeCost {
    float areas = 0.0f;

    /// Adds the children of a node, the first one first. Returns the box around them.
    PlaneBox add(const PlainNode& node) {
        PlaneBox all;
        const unsigned children = node.node_children() + node.leaf_children();
        for (unsigned child = 0; child < children; ++child) {
            std::uint32_t side[3];
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t low = load_u16(node.low_planes(k) + 2 * std::size_t{child});
                const std::uint32_t high = load_u16(node.high_planes(k) + 2 * std::size_t{child});
                all.low[k] = low < all.low[k] ? low : all.low[k];
                all.high[k] = high > all.high[k] ? high : all.high[k];
                side[k] = high - low + 1;
            }
            areas += half_area_of_sides(side[0], side[1], side[2]);
        }
        return all;
    }
    /// Returns the expected number of boxes that a ray enters which enters the root's.
    [[nodiscard]] float over(const PlaneBox& root) const { return areas / root.half_area(); }
};

/// Returns the cost of the tree of a blob with plain nodes, one at least.
inline float cost_of_tree(const BlobData& blob) {
    TreeCost cost;
    PlaneBox box;
    for (std::uint32_t number = blob.node_count; number-- != 0;) box = cost.add(node_at<PlainNode>(blob, number));
    return cost.over(box);
}

}  // namespace espalier::detail
