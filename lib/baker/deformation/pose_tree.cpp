#include <baker/deformation/pose_tree.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

#include <baker/build/leaves_added.hpp>

namespace espalier::baker {

namespace {

/// A plane across an axis of a pose.
struct PoseSplit {
    float cost = infinity;
    std::size_t pose = 0;
    unsigned axis = 0;
    float plane = 0.0f;  ///< twice the centre of a box on the left is below
};

class PoseTreeBuilder {
public:
    PoseTreeBuilder(const PoseBoxes& boxes, const BuildSettings& settings, BinaryTree& tree)
        : boxes_(boxes), settings_(settings), tree_(tree), range_boxes_(boxes.pose_count()) {}

    void build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth) {
        tree_.nodes[node].first = first;
        tree_.nodes[node].count = count;
        if (count == 1) return;
        const std::uint32_t left = split(std::span(tree_.triangles).subspan(first, count), depth);
        build(first, left, node + 1, depth + 1);
        build(first + left, count - left, node + 1 + subtree_nodes(left), depth + 1);
    }

private:
    using Numbers = std::span<std::uint32_t>;

    [[nodiscard]] float center(std::uint32_t triangle, std::size_t pose, unsigned axis) const {
        const LaneBox& box = boxes_.of(triangle)[pose];
        return box.lo[axis] + box.hi[axis];
    }

    /// Reorders the triangles of a range, two or more. Returns how many are left of the split.
    std::uint32_t split(Numbers range, unsigned depth) {
        const auto count = static_cast<std::uint32_t>(range.size());
        if (count == 2) return 1;
        PoseSplit best;
        if (leaves_room(depth, count - 1, settings_.most_height)) best = best_split(range);
        const auto is_left = [&](std::uint32_t triangle) {
            return center(triangle, best.pose, best.axis) < best.plane;
        };
        const auto left =
            static_cast<std::uint32_t>(std::stable_partition(range.begin(), range.end(), is_left) - range.begin());
        return left == 0 || left == count ? split_in_halves(range) : left;
    }

    /// Halves along the axis of the mesh's own pose in which the centres spread most.
    std::uint32_t split_in_halves(Numbers range) const {
        unsigned widest = 0;
        float most = -1.0f;
        for (unsigned axis = 0; axis < 3; ++axis) {
            const auto [low, high] = spread(range, 0, axis);
            if (high - low > most) {
                most = high - low;
                widest = axis;
            }
        }
        const auto is_before = [&](std::uint32_t a, std::uint32_t b) {
            const float at_a = center(a, 0, widest), at_b = center(b, 0, widest);
            return at_a != at_b ? at_a < at_b : a < b;
        };
        const std::size_t half = range.size() / 2;
        std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(half), range.end(), is_before);
        return static_cast<std::uint32_t>(half);
    }

    struct Spread {
        float low, high;
    };
    [[nodiscard]] Spread spread(Numbers range, std::size_t pose, unsigned axis) const {
        Spread spread{infinity, -infinity};
        for (const std::uint32_t triangle : range) {
            const float at = center(triangle, pose, axis);
            spread = {std::min(spread.low, at), std::max(spread.high, at)};
        }
        return spread;
    }

    PoseSplit best_split(Numbers range) {
        std::fill(range_boxes_.begin(), range_boxes_.end(), LaneBox{});
        for (const std::uint32_t triangle : range) add(range_boxes_, boxes_.of(triangle));
        const auto count = static_cast<std::uint32_t>(range.size());
        const LeavesAdded leaves(count, boxes_.area(range_boxes_), settings_.full_leaf);
        PoseSplit best;
        for (std::size_t pose = 0; pose < boxes_.pose_count(); ++pose)
            for (unsigned axis = 0; axis < 3; ++axis) try_planes(range, pose, axis, leaves, best);
        return best;
    }

    void try_planes(Numbers range, std::size_t pose, unsigned axis, const LeavesAdded& leaves, PoseSplit& best) {
        const auto [low, high] = spread(range, pose, axis);
        if (!(low < high)) return;
        const auto count = static_cast<std::uint32_t>(range.size());
        const std::size_t bins = std::min<std::size_t>(settings_.bins, 4 + count / 2), poses = boxes_.pose_count();
        const float width = (high - low) / static_cast<float>(bins);
        planes_.clear();
        for (std::size_t bin = 1; bin < bins; ++bin) planes_.push_back(low + width * static_cast<float>(bin));
        bin_boxes_.assign(bins * poses, LaneBox{});
        bin_counts_.assign(bins, 0);
        for (const std::uint32_t triangle : range) {
            // The bin by the same comparison as the split.
            const float at = center(triangle, pose, axis);
            const auto bin =
                static_cast<std::size_t>(std::upper_bound(planes_.begin(), planes_.end(), at) - planes_.begin());
            add(std::span(bin_boxes_).subspan(bin * poses, poses), boxes_.of(triangle));
            ++bin_counts_[bin];
        }
        right_costs_.assign(bins, infinity);
        side_boxes_.assign(poses, LaneBox{});
        std::uint32_t right_count = 0;
        for (std::size_t bin = bins - 1; bin > 0; --bin) {
            right_count += bin_counts_[bin];
            add(side_boxes_, std::span(bin_boxes_).subspan(bin * poses, poses));
            if (right_count != 0) right_costs_[bin] = boxes_.area(side_boxes_) * static_cast<float>(right_count);
        }
        side_boxes_.assign(poses, LaneBox{});
        std::uint32_t left_count = 0;
        for (std::size_t bin = 1; bin < bins; ++bin) {
            left_count += bin_counts_[bin - 1];
            add(side_boxes_, std::span(bin_boxes_).subspan((bin - 1) * poses, poses));
            if (left_count == 0) continue;
            const float areas = boxes_.area(side_boxes_) * static_cast<float>(left_count) + right_costs_[bin];
            const float cost = areas + leaves.cost(left_count);
            if (cost < best.cost) best = {cost, pose, axis, planes_[bin - 1]};
        }
    }

    const PoseBoxes& boxes_;
    const BuildSettings& settings_;
    BinaryTree& tree_;
    // The working arrays of one split at a time.
    std::vector<LaneBox> range_boxes_, bin_boxes_, side_boxes_;
    std::vector<std::uint32_t> bin_counts_;
    std::vector<float> planes_, right_costs_;
};

}  // namespace

BinaryTree build_over_poses(const PoseBoxes& boxes, std::uint32_t triangles, const BuildSettings& settings) {
    BinaryTree tree;
    tree.nodes = std::make_unique<BinaryNode[]>(subtree_nodes(triangles));
    tree.triangles.resize(triangles);
    std::iota(tree.triangles.begin(), tree.triangles.end(), 0u);
    PoseTreeBuilder(boxes, settings, tree).build(0, triangles, 0, 0);
    return tree;
}

}  // namespace espalier::baker
