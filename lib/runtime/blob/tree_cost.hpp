// The cost of a tree of plain nodes for an average ray, by the surface area heuristic (Goldsmith and Salmon 1987).
#pragma once

#include <runtime/blob/node.hpp>

namespace espalier::detail {

/// A box of whole numbers: of planes around children of a node in units, or of vertices in lattice steps.
struct UnsignedBox {
    std::uint32_t low[3] = {~std::uint32_t{0}, ~std::uint32_t{0}, ~std::uint32_t{0}};
    std::uint32_t high[3] = {0, 0, 0};

    void add(const UnsignedBox& box) {
        for (int k = 0; k < 3; ++k) {
            low[k] = box.low[k] < low[k] ? box.low[k] : low[k];
            high[k] = box.high[k] > high[k] ? box.high[k] : high[k];
        }
    }
    /// Returns half the surface, both ends included.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE float half_area() const {
        const auto side = [&](int k) { return static_cast<float>(static_cast<std::int32_t>(high[k] - low[k] + 1)); };
        const float a = side(0), b = side(1), c = side(2);
        return (a * b + b * c) + c * a;
    }
};

/// The areas of the boxes of a tree, added node by node from the last to the first: on every machine in one order.
struct TreeCost {
    float areas = 0.0f;

    /// Adds the children of a node, the first one first. Returns the box around them.
    UnsignedBox add(const PlainNode& node) {
        UnsignedBox all;
        const unsigned children = node.node_children() + node.leaf_children();
        for (unsigned child = 0; child < children; ++child) {
            UnsignedBox box;
            for (int k = 0; k < 3; ++k) {
                box.low[k] = load_u16(node.low_planes(k) + 2 * std::size_t{child});
                box.high[k] = load_u16(node.high_planes(k) + 2 * std::size_t{child});
            }
            areas += box.half_area();
            all.add(box);
        }
        return all;
    }
    /// Returns the expected number of boxes that a ray enters which enters the root's.
    [[nodiscard]] float over(const UnsignedBox& root) const { return areas / root.half_area(); }
};

/// Returns the cost of the tree of a blob with plain nodes, one at least.
inline float cost_of_tree(const BlobData& blob) {
    TreeCost cost;
    UnsignedBox box;
    for (std::uint32_t number = blob.node_count; number-- != 0;) box = cost.add(node_at<PlainNode>(blob, number));
    return cost.over(box);
}

}  // namespace espalier::detail
