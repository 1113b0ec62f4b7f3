// One tree, walked by one function, with any kernel in its leaves: only the kernel can lose a hit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "../traversal/aabb_tree.hpp"

namespace espalier::bench {

/// The slabs of boxes (Kay, Kajiya 1986) along one ray. Boxes are enlarged by more than the tests round.
class SlabTest {
public:
    SlabTest(const AabbTree& tree, const Ray& ray) {
        const float from[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
        const float along[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
        float farthest = tree.largest;
        for (int k = 0; k < 3; ++k) {
            // A direction of 0 along an axis becomes a very small one: 1 / 0 would lead to 0 times infinity.
            inverse_[k] = 1.0f / std::copysign(std::max(std::abs(along[k]), 1e-18f), along[k]);
            magnitude_[k] = std::abs(inverse_[k]);
            origin_[k] = from[k];
            farthest = std::max(farthest, std::abs(from[k]));
        }
        margin_ = 0x1p-20f * farthest;
    }
    /// Returns t where the ray enters the box, or infinity if it misses the box or enters it behind `nearest`.
    [[nodiscard]] float entry(const AabbNode& node, float nearest) const {
        float begin = 0.0f, end = nearest;
        for (int k = 0; k < 3; ++k) {
            const float middle = (node.center[k] - origin_[k]) * inverse_[k];
            const float reach = (node.half[k] + margin_) * magnitude_[k];
            begin = std::max(begin, middle - reach);
            end = std::min(end, middle + reach);
        }
        return begin <= end ? begin : std::numeric_limits<float>::infinity();
    }

private:
    float origin_[3], inverse_[3], magnitude_[3];
    float margin_;
};

/// Calls test_leaf(leaf, nearest), which lowers `nearest`, for the leaves that the ray enters before `nearest`, the
/// nearer child first. Returns the last `nearest`.
template <class TestLeaf>
float walk_leaves(const AabbTree& tree, const Ray& ray, TestLeaf test_leaf) {
    constexpr float none = std::numeric_limits<float>::infinity();
    constexpr std::size_t most_levels = 128;
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    Waiting stack[most_levels];
    std::size_t size = 0;
    float nearest = none;
    const SlabTest slabs(tree, ray);
    if (tree.height >= most_levels || slabs.entry(tree.nodes[0], nearest) == none) return none;
    std::uint32_t index = 0;
    for (;;) {
        const AabbNode& node = tree.nodes[index];
        if (node.is_leaf()) {
            test_leaf(node, nearest);
        } else {
            std::uint32_t near = node.first, far = node.first + 1;
            float near_entry = slabs.entry(tree.nodes[near], nearest),
                  far_entry = slabs.entry(tree.nodes[far], nearest);
            if (far_entry < near_entry) {
                std::swap(near, far);
                std::swap(near_entry, far_entry);
            }
            if (far_entry != none) stack[size++] = {far, far_entry};
            if (near_entry != none) {
                index = near;
                continue;
            }
        }
        while (size > 0 && stack[size - 1].entry > nearest) --size;
        if (size == 0) return nearest;
        index = stack[--size].node;
    }
}

/// Returns t of the closest hit, or infinity.
template <class Kernel>
float closest_hit(const AabbTree& tree, const Kernel& kernel, const Ray& ray) {
    typename Kernel::Prepared prepared;
    if (!kernel.prepare(ray, prepared)) return std::numeric_limits<float>::infinity();
    return walk_leaves(tree, ray, [&](const AabbNode& leaf, float& nearest) {
        for (std::size_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            nearest = std::min(nearest, kernel.test(prepared, i));
    });
}

/// The same by a test of every triangle.
template <class Kernel>
float closest_of_all(const AabbTree& tree, const Kernel& kernel, const Ray& ray) {
    float nearest = std::numeric_limits<float>::infinity();
    typename Kernel::Prepared prepared;
    if (kernel.prepare(ray, prepared))
        for (std::size_t i = 0; i < tree.triangles.size(); ++i) nearest = std::min(nearest, kernel.test(prepared, i));
    return nearest;
}

}  // namespace espalier::bench
