// Walks through trees of volumes of any kind: the same steps, so that the kinds alone make a difference.
#pragma once

#include <algorithm>
#include <limits>

#include "../traversal/corners.hpp"
#include "../traversal/placed_triangle.hpp"
#include "ball_tests.hpp"
#include "kinds.hpp"
#include "pair_tests.hpp"
#include "trees.hpp"

namespace espalier::bench {

/// Finds the closest hit of a ray, the nearer of two children first, as section 7 of the guide describes.
template <class Stored>
class VolumeRayWalk {
public:
    explicit VolumeRayWalk(const VolumeTree<Stored>& tree) : tree_(&tree), stack_(tree.topology->height + 1) {}

    /// Returns t of the closest hit, or infinity. Calls `visit(node)` for each volume that is tested.
    template <class Visit>
    double closest(const Ray& ray, VolumeWork& work, const Visit& visit) {
        const PreparedRay<Stored> prepared(ray);
        const Line line = {point_of(ray.origin), point_of(ray.direction)};
        double nearest = std::numeric_limits<double>::infinity();
        const auto entry = [&](std::uint32_t node) {
            ++work.volume_tests;
            visit(node);
            return prepared.entry(tree_->nodes[node].volume);
        };
        const auto is_ahead = [&](float at) { return at != no_entry && static_cast<double>(at) <= nearest; };
        std::size_t size = 0;
        stack_[size++] = {0, entry(0)};
        while (size > 0) {
            const Waiting top = stack_[--size];
            if (!is_ahead(top.entry)) continue;
            std::uint32_t index = top.node;
            while (tree_->nodes[index].count == 0) {
                const std::uint32_t first = tree_->nodes[index].first;
                Waiting near = {first, entry(first)}, far = {first + 1, entry(first + 1)};
                if (far.entry < near.entry) std::swap(near, far);
                if (!is_ahead(near.entry)) break;
                if (is_ahead(far.entry)) stack_[size++] = far;
                index = near.node;
            }
            const auto& leaf = tree_->nodes[index];
            work.triangle_tests += leaf.count;
            if (leaf.count == 0) continue;
            for (const FloatTriangle& triangle : tree_->triangles_of(leaf))
                if (const auto at = meets(corners_of(triangle), line)) nearest = std::min(nearest, *at);
        }
        return nearest;
    }
    double closest(const Ray& ray, VolumeWork& work) {
        return closest(ray, work, [](std::uint32_t) {});
    }

private:
    struct Waiting {
        std::uint32_t node;
        float entry;
    };
    const VolumeTree<Stored>* tree_;
    std::vector<Waiting> stack_;
};

/// Counts the triangles that a ball touches.
template <class Stored>
class VolumeBallWalk {
public:
    explicit VolumeBallWalk(const VolumeTree<Stored>& tree) : tree_(&tree), stack_(tree.topology->height + 2) {}

    [[nodiscard]] std::uint64_t count(const Ball& ball, VolumeWork& work) {
        const PreparedBall<Stored> prepared(ball);
        std::uint64_t touching = 0;
        std::size_t size = 0;
        stack_[size++] = 0;
        while (size > 0) {
            const auto& node = tree_->nodes[stack_[--size]];
            ++work.volume_tests;
            if (!prepared.touches(node.volume)) continue;
            if (node.count == 0) {
                stack_[size++] = node.first + 1;
                stack_[size++] = node.first;
                continue;
            }
            work.triangle_tests += node.count;
            for (const FloatTriangle& triangle : tree_->triangles_of(node))
                touching += touches(corners_of(triangle), ball) ? 1u : 0u;
        }
        return touching;
    }

private:
    const VolumeTree<Stored>* tree_;
    std::vector<std::uint32_t> stack_;
};

/// Counts the pairs of triangles that touch, of a mesh and the same mesh in a pose. All children of both nodes replace
/// a pair, so that each child is placed once for two tests.
template <class Stored>
class VolumePairWalk {
public:
    explicit VolumePairWalk(const VolumeTree<Stored>& tree)
        : tree_(&tree), stack_(6 * std::size_t{tree.topology->height} + 1) {}

    /// Calls `visit(a, b)` for each pair of volumes that is tested.
    template <class Visit>
    [[nodiscard]] std::uint64_t count(const Placement& placement, VolumeWork& work, const Visit& visit) {
        const PreparedPose<Stored> pose(placement);
        const AabbTree& topology = *tree_->topology;
        const float* t = placement.shift;
        const auto largest =
            static_cast<double>(2.0f * topology.largest + std::abs(t[0]) + std::abs(t[1]) + std::abs(t[2]));
        std::uint64_t touching = 0;
        std::size_t size = 0;
        const auto push_touching = [&](const Range& of_a, const Range& of_b) {
            for (std::uint32_t b = of_b.first; b < of_b.end; ++b) {
                const typename PreparedPose<Stored>::Placed placed = pose.placed(tree_->nodes[b].volume);
                for (std::uint32_t a = of_a.first; a < of_a.end; ++a) {
                    ++work.volume_tests;
                    visit(a, b);
                    if (pose.touch(tree_->nodes[a].volume, placed)) stack_[size++] = {a, b};
                }
            }
        };
        push_touching({0, 1}, {0, 1});
        while (size > 0) {
            const Entry top = stack_[--size];
            const auto& a = tree_->nodes[top.a];
            const auto& b = tree_->nodes[top.b];
            if (a.count == 0 || b.count == 0) {
                push_touching(a.count == 0 ? Range{a.first, a.first + 2} : Range{top.a, top.a + 1},
                              b.count == 0 ? Range{b.first, b.first + 2} : Range{top.b, top.b + 1});
                continue;
            }
            work.triangle_tests += std::uint64_t{a.count} * b.count;
            for (const FloatTriangle& of_b : tree_->triangles_of(b)) {
                const PlacedTriangle placed(of_b, placement.exact, largest);
                for (const FloatTriangle& of_a : tree_->triangles_of(a)) touching += placed.touches(of_a) ? 1u : 0u;
            }
        }
        return touching;
    }
    [[nodiscard]] std::uint64_t count(const Placement& placement, VolumeWork& work) {
        return count(placement, work, [](std::uint32_t, std::uint32_t) {});
    }

private:
    struct Entry {
        std::uint32_t a;
        std::uint32_t b;
    };
    struct Range {
        std::uint32_t first;
        std::uint32_t end;
    };
    const VolumeTree<Stored>* tree_;
    std::vector<Entry> stack_;
};

}  // namespace espalier::bench
