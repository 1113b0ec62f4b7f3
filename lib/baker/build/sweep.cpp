#include <baker/build/sweep.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <baker/base/fork_join.hpp>
#include <baker/build/sah_split.hpp>

namespace espalier::baker {

namespace {

using Numbers = std::vector<std::uint32_t>;

struct SweepSplit {
    float cost = std::numeric_limits<float>::infinity();
    unsigned axis = 0;
    std::uint32_t left_count = 0;
};

/// Every range first .. first + count - 1 holds the same triangles in all three orders. Threads work in ranges that do
/// not overlap, and so in different places of every array.
class SweepBuilder {
public:
    SweepBuilder(const LatticeMesh& mesh, const BuildSettings& settings, BinaryNode* nodes)
        : settings_(settings),
          nodes_(nodes),
          references_(mesh.triangles.size()),
          right_costs_(mesh.triangles.size()),
          moved_(mesh.triangles.size()),
          is_left_(mesh.triangles.size()) {
        const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
        for (std::uint32_t i = 0; i < count; ++i) put_reference(mesh, i, references_[i]);
        for (unsigned axis = 0; axis < 3; ++axis) {
            orders_[axis].resize(count);
            std::iota(orders_[axis].begin(), orders_[axis].end(), 0u);
            std::sort(orders_[axis].begin(), orders_[axis].end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ByCenter{axis}(references_[a], references_[b]); });
        }
    }

    void build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth, unsigned threads) {
        BinaryNode& written = nodes_[node];
        LaneBox box;
        for (std::uint32_t i = first; i < first + count; ++i) box.add(box_at(0, i));
        std::memcpy(&written, &box, sizeof written);
        written.first = first;
        written.count = count;
        if (count == 1) return;
        const bool must_balance = !leaves_room(depth, count - 1, settings_.most_height);
        const SweepSplit split = must_balance ? halves(first, count) : best_split(first, count);
        part(first, count, split);
        const std::uint32_t right_count = count - split.left_count;
        fork_join(
            threads, split.left_count, right_count,
            [&](unsigned share) { build(first, split.left_count, node + 1, depth + 1, share); },
            [&](unsigned share) {
                build(first + split.left_count, right_count, node + 1 + subtree_nodes(split.left_count), depth + 1,
                      share);
            });
    }

    [[nodiscard]] Numbers& triangles() { return orders_[0]; }

private:
    [[nodiscard]] LaneBox box_at(unsigned axis, std::uint32_t place) const {
        return lane_box_of(references_[orders_[axis][place]]);
    }

    [[nodiscard]] SweepSplit best_split(std::uint32_t first, std::uint32_t count) {
        SweepSplit best{std::numeric_limits<float>::infinity(), 0, count / 2};
        for (unsigned axis = 0; axis < 3; ++axis) {
            LaneBox right;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                right.add(box_at(axis, first + i));
                right_costs_[first + i] = right.half_area() * static_cast<float>(count - i);
            }
            LaneBox left;
            for (std::uint32_t i = 1; i < count; ++i) {
                left.add(box_at(axis, first + i - 1));
                const float cost = left.half_area() * static_cast<float>(i) + right_costs_[first + i];
                if (cost < best.cost) best = {cost, axis, i};
            }
        }
        return best;
    }

    /// Along the axis in which the centres spread most.
    [[nodiscard]] SweepSplit halves(std::uint32_t first, std::uint32_t count) const {
        std::array<float, 3> spread;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const Numbers& order = orders_[axis];
            spread[axis] =
                center_of(references_[order[first + count - 1]], axis) - center_of(references_[order[first]], axis);
        }
        const auto widest = std::max_element(spread.begin(), spread.end());
        return {0.0f, static_cast<unsigned>(widest - spread.begin()), count / 2};
    }

    /// Brings what stays left to the front in the two other orders, and keeps them sorted.
    void part(std::uint32_t first, std::uint32_t count, const SweepSplit& split) {
        const Numbers& sorted = orders_[split.axis];
        for (std::uint32_t i = 0; i < count; ++i) is_left_[sorted[first + i]] = i < split.left_count ? 1 : 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (axis == split.axis) continue;
            Numbers& order = orders_[axis];
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

    const BuildSettings& settings_;
    BinaryNode* nodes_;
    std::vector<Reference> references_;
    std::array<Numbers, 3> orders_;
    std::vector<float> right_costs_;
    Numbers moved_;
    std::vector<std::uint8_t> is_left_;
};

}  // namespace

BinaryTree build_sweep(const LatticeMesh& mesh, const BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    SweepBuilder builder(mesh, settings, tree.nodes.get());
    builder.build(0, count, 0, 0, settings.threads);
    tree.triangles = std::move(builder.triangles());
    return tree;
}

}  // namespace espalier::baker
