// A query of a box in the textbook tree.
#pragma once

#include <cstdint>
#include <vector>

#include "cells.hpp"

namespace espalier::bench {

class TreeBoxes {
public:
    explicit TreeBoxes(const AabbTree& tree) : tree_(&tree) {}

    /// Counts the triangles that touch the box.
    [[nodiscard]] std::size_t count_touching(const Aabb& box, CellWork& work) {
        float center[3], half[3];
        for (std::size_t k = 0; k < 3; ++k) {
            center[k] = 0.5f * (box.low[k] + box.high[k]);
            half[k] = 0.5f * (box.high[k] - box.low[k]);
        }
        const auto is_near = [&](const AabbNode& node) {
            ++work.cells;
            for (int k = 0; k < 3; ++k)
                if (std::abs(node.center[k] - center[k]) > node.half[k] + half[k]) return false;
            return true;
        };
        const TriangleBoxTest test(box);
        std::size_t touching = 0;
        stack_.assign(1, 0);
        while (!stack_.empty()) {
            const AabbNode& node = tree_->nodes[stack_.back()];
            stack_.pop_back();
            if (node.is_leaf()) {
                work.triangle_tests += node.count;
                for (const FloatTriangle& triangle : tree_->triangles_of(node))
                    touching += test.touches(corners_of(triangle)) ? 1u : 0u;
                continue;
            }
            for (const std::uint32_t child : {node.first, node.first + 1})
                if (is_near(tree_->nodes[child])) stack_.push_back(child);
        }
        return touching;
    }

private:
    const AabbTree* tree_;
    std::vector<std::uint32_t> stack_;
};

}  // namespace espalier::bench
