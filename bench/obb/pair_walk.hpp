// Two trees of boxes against each other, for boxes of any kind: the same steps, so that the kinds alone make a
// difference.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "../traversal/corners.hpp"
#include "../traversal/placed_triangle.hpp"
#include "../volumes/pair_tests.hpp"
#include "box_trees.hpp"

namespace espalier::bench {

/// Encloses a placed AABB in one along the axes of the first tree, and tests three intervals (van den Bergen 1997).
class ReboxingPose {
public:
    using Placed = StoredAabb;
    explicit ReboxingPose(const Placement& placement) : placement_(&placement) {}
    [[nodiscard]] Placed placed(const StoredAabb& b) const {
        Placed moved;
        place(*placement_, b.center, moved.center);
        for (int i = 0; i < 3; ++i) moved.half[i] = dot3(placement_->magnitude[i], b.half);
        return moved;
    }
    [[nodiscard]] bool touch(const StoredAabb& a, const Placed& b) const {
        for (int i = 0; i < 3; ++i)
            if (std::abs(b.center[i] - a.center[i]) > a.half[i] + b.half[i]) return false;
        return true;
    }

private:
    const Placement* placement_;
};

/// A tree with boxes of one kind, which belong to its nodes.
template <class Stored>
struct BoxTree {
    const AabbTree* tree;
    const BoxNodes<Stored>* boxes;
};

/// A walk in which all children of both nodes replace a pair, so that each child is placed once for two tests. `Pose`
/// tests the boxes: PreparedPose<StoredObb> or PreparedPose<StoredAabb> by 15 axes, ReboxingPose by 3.
template <class Pose, class Stored>
class BoxPairWalk {
public:
    BoxPairWalk(BoxTree<Stored> a, BoxTree<Stored> b)
        : a_(a), b_(b), stack_(3 * (std::size_t{a.tree->height} + b.tree->height) + 1) {}

    [[nodiscard]] PairWork run(PairQuestion question, const Placement& placement) {
        const Pose pose(placement);
        const float* t = placement.shift;
        const auto largest = static_cast<double>(
            std::max(a_.tree->largest, 2.0f * b_.tree->largest + std::abs(t[0]) + std::abs(t[1]) + std::abs(t[2])));
        const std::span nodes_a(*a_.boxes), nodes_b(*b_.boxes);
        PairWork work;
        std::size_t size = 0;
        const auto push_touching = [&](const Range& of_a, const Range& of_b) {
            for (std::uint32_t b = of_b.first; b < of_b.end; ++b) {
                const typename Pose::Placed placed = pose.placed(nodes_b[b].volume);
                for (std::uint32_t a = of_a.first; a < of_a.end; ++a) {
                    ++work.box_tests;
                    if (pose.touch(nodes_a[a].volume, placed)) stack_[size++] = {a, b};
                }
            }
        };
        push_touching({0, 1}, {0, 1});
        while (size > 0) {
            const Entry top = stack_[--size];
            const auto& a = nodes_a[top.a];
            const auto& b = nodes_b[top.b];
            if (a.count == 0 || b.count == 0) {
                push_touching(a.count == 0 ? Range{a.first, a.first + 2} : Range{top.a, top.a + 1},
                              b.count == 0 ? Range{b.first, b.first + 2} : Range{top.b, top.b + 1});
                continue;
            }
            const PlacedTriangle placed(b_.tree->triangles[b.first], placement.exact, largest);
            ++work.triangle_tests;
            if (!placed.touches(a_.tree->triangles[a.first])) continue;
            ++work.pairs;
            if (question == PairQuestion::any) break;
        }
        return work;
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
    BoxTree<Stored> a_, b_;
    std::vector<Entry> stack_;
};

}  // namespace espalier::bench
