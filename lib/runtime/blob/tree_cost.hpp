// The cost of a tree of plain nodes for an average ray, by the surface area heuristic (Goldsmith and Salmon 1987).
#pragma once

#include <runtime/blob/node.hpp>

namespace espalier::detail {

/// A box of whole numbers: of planes around children of a node in units, or of vertices in lattice steps.
struct UnsignedBox {
    std::uint32_t low[3] = {~std::uint32_t{0}, ~std::uint32_t{0}, ~std::uint32_t{0}};
    std::uint32_t high[3] = {0, 0, 0};

    void add(int k, std::uint32_t from, std::uint32_t to) {
        low[k] = from < low[k] ? from : low[k];
        high[k] = to > high[k] ? to : high[k];
    }
    void add(const UnsignedBox& box) {
        for (int k = 0; k < 3; ++k) add(k, box.low[k], box.high[k]);
    }
    /// Returns the length of a side, both ends included.
    [[nodiscard]] std::uint32_t side(int k) const { return high[k] - low[k] + 1; }
};

/// Returns half the surface of a box with these sides.
ESPALIER_ALWAYS_INLINE inline float half_area(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const float a = static_cast<float>(static_cast<std::int32_t>(x));
    const float b = static_cast<float>(static_cast<std::int32_t>(y));
    const float c = static_cast<float>(static_cast<std::int32_t>(z));
    return (a * b + b * c) + c * a;
}

/// The areas of the boxes of a tree, added node by node from the last to the first: on every machine in one order.
struct TreeCost {
    float areas = 0.0f;

    /// Adds the children of a node, the first one first. Returns the box around them.
    UnsignedBox add(const PlainNode& node) {
        UnsignedBox all;
        const unsigned children = node.node_children() + node.leaf_children();
        for (unsigned child = 0; child < children; ++child) {
            std::uint32_t side[3];
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t low = load_u16(node.low_planes(k) + 2 * std::size_t{child});
                const std::uint32_t high = load_u16(node.high_planes(k) + 2 * std::size_t{child});
                all.add(k, low, high);
                side[k] = high - low + 1;
            }
            areas += half_area(side[0], side[1], side[2]);
        }
        return all;
    }
    /// Returns the expected number of boxes that a ray enters which enters the root's.
    [[nodiscard]] float over(const UnsignedBox& root) const {
        return areas / half_area(root.side(0), root.side(1), root.side(2));
    }
};

/// Returns the cost of the tree of a blob with plain nodes, one at least.
inline float cost_of_tree(const BlobData& blob) {
    TreeCost cost;
    UnsignedBox box;
    for (std::uint32_t number = blob.node_count; number-- != 0;) box = cost.add(node_at<PlainNode>(blob, number));
    return cost.over(box);
}

}  // namespace espalier::detail
