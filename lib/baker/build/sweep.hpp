// A binary tree by the surface area heuristic over every split of the sorted triangles, or by another rule over these.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <vector>

#include <baker/base/fork_join.hpp>
#include <baker/build/binary_tree.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The first triangles of a range, in their order along an axis, go left.
struct SortedSplit {
    unsigned axis = 0;
    std::uint32_t left_count = 0;
};

/// Every range first .. first + count - 1 holds the same triangles in all three orders. Threads work in ranges that do
/// not overlap, and so in different places of every array.
class SortedOrders {
public:
    explicit SortedOrders(const LatticeMesh& mesh)
        : references_(mesh.triangles.size()), moved_(mesh.triangles.size()), is_left_(mesh.triangles.size()) {
        const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
        for (std::uint32_t i = 0; i < count; ++i) put_reference(mesh, i, references_[i]);
        for (unsigned axis = 0; axis < 3; ++axis) {
            orders_[axis].resize(count);
            std::iota(orders_[axis].begin(), orders_[axis].end(), 0u);
            std::sort(orders_[axis].begin(), orders_[axis].end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ByCenter{axis}(references_[a], references_[b]); });
        }
    }
    [[nodiscard]] LaneBox box_at(unsigned axis, std::uint32_t place) const {
        return lane_box_of(references_[orders_[axis][place]]);
    }

    /// Builds below a node. `best_split(orders, first, count)` returns the split of a range of two or more, which may
    /// become as high as the settings allow.
    template <class BestSplit>
    void build(std::uint32_t first, std::uint32_t count, BinaryNode* nodes, std::size_t node, unsigned depth,
               unsigned threads, const BuildSettings& settings, const BestSplit& best_split) {
        BinaryNode& written = nodes[node];
        LaneBox box;
        for (std::uint32_t i = first; i < first + count; ++i) box.add(box_at(0, i));
        std::memcpy(&written, &box, sizeof written);
        written.first = first;
        written.count = count;
        if (count == 1) return;
        const bool must_balance = !leaves_room(depth, count - 1, settings.most_height);
        const SortedSplit split = must_balance ? halves(first, count) : best_split(*this, first, count);
        part(first, count, split);
        const std::uint32_t right_count = count - split.left_count;
        fork_join(
            threads, split.left_count, right_count,
            [&](unsigned share) {
                build(first, split.left_count, nodes, node + 1, depth + 1, share, settings, best_split);
            },
            [&](unsigned share) {
                build(first + split.left_count, right_count, nodes, node + 1 + subtree_nodes(split.left_count),
                      depth + 1, share, settings, best_split);
            });
    }
    /// Returns the triangles in the order of the leaves.
    [[nodiscard]] std::vector<std::uint32_t>& triangles() { return orders_[0]; }

private:
    /// Along the axis in which the centres spread most.
    [[nodiscard]] SortedSplit halves(std::uint32_t first, std::uint32_t count) const {
        std::array<float, 3> spread;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const auto& order = orders_[axis];
            spread[axis] =
                center_of(references_[order[first + count - 1]], axis) - center_of(references_[order[first]], axis);
        }
        const auto widest = std::max_element(spread.begin(), spread.end());
        return {static_cast<unsigned>(widest - spread.begin()), count / 2};
    }

    /// Brings what stays left to the front in the two other orders, and keeps them sorted.
    void part(std::uint32_t first, std::uint32_t count, const SortedSplit& split) {
        const auto& sorted = orders_[split.axis];
        for (std::uint32_t i = 0; i < count; ++i) is_left_[sorted[first + i]] = i < split.left_count ? 1 : 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (axis == split.axis) continue;
            auto& order = orders_[axis];
            std::uint32_t left = first;
            std::uint32_t right = first;
            for (std::uint32_t i = first; i < first + count; ++i) {
                const std::uint32_t triangle = order[i];
                if (is_left_[triangle] != 0) order[left++] = triangle;
                else moved_[right++] = triangle;
            }
            std::copy(moved_.begin() + first, moved_.begin() + right, order.begin() + left);
        }
    }

    std::vector<Reference> references_;
    std::array<std::vector<std::uint32_t>, 3> orders_;
    std::vector<std::uint32_t> moved_;
    std::vector<std::uint8_t> is_left_;
};

/// Builds a tree whose splits are those that `best_split` returns, unless it would become too high.
template <class BestSplit>
BinaryTree build_sorted(const LatticeMesh& mesh, const BuildSettings& settings, const BestSplit& best_split) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    SortedOrders orders(mesh);
    orders.build(0, count, tree.nodes.get(), 0, 0, settings.threads, settings, best_split);
    tree.triangles = std::move(orders.triangles());
    return tree;
}

/// Sorts once along every axis and keeps the orders while splitting, O(n log n): "Heuristics for ray tracing using
/// space subdivision" (MacDonald, Booth 1990), as a full sweep in "Ray tracing deformable scenes using dynamic bounding
/// volume hierarchies" (Wald, Boulos, Shirley 2007). As `build`.
[[nodiscard]] BinaryTree build_sweep(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
