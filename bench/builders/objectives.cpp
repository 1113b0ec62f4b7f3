#include "builders.hpp"

#include "top_down.hpp"

namespace espalier::bench {
namespace {

using namespace baker;

double volume(const LaneBox& box) {
    const Lanes side = box.hi - box.lo;
    return double(side[0]) * double(side[1]) * double(side[2]);
}

double area(const LaneBox& box) { return double(box.half_area()); }

/// Returns half the surface of what the boxes have in common, and -1 where they are apart.
double intersection_area(const LaneBox& a, const LaneBox& b) {
    LaneBox both;
    both.lo = larger(a.lo, b.lo);
    both.hi = smaller(a.hi, b.hi);
    for (int axis = 0; axis < 3; ++axis)
        if (both.lo[axis] > both.hi[axis]) return -1.0;
    return area(both);
}

/// The children of a split along an axis.
struct Children {
    unsigned axis;
    const LaneBox& left;
    const LaneBox& right;
    std::uint32_t left_count;
    std::uint32_t right_count;
};

/// Returns what the best split has least of.
double cost(Objective objective, const Children& children) {
    switch (objective) {
        case Objective::sum_of_volumes:
            return volume(children.left) + volume(children.right);
        case Objective::sum_of_areas:
        case Objective::bounded_sum_of_areas:
            return area(children.left) + area(children.right);
        case Objective::maximum_area:
            return std::max(area(children.left), area(children.right));
        case Objective::intersection_area:
            return intersection_area(children.left, children.right);
        case Objective::separation:
            return double(children.left.hi[children.axis]) - double(children.right.lo[children.axis]);
        case Objective::weighted_sum_of_areas:
            return area(children.left) * children.left_count + area(children.right) * children.right_count;
    }
    return 0.0;
}

struct BestSplit {
    double cost = std::numeric_limits<double>::infinity();
    unsigned axis = 0;
    std::uint32_t left_count = 0;
};

/// Sorts once along each axis. A range first .. first + count - 1 holds the same triangles in all three orders.
class ObjectiveBuilder {
public:
    ObjectiveBuilder(const LatticeMesh& mesh, Objective objective, const BuildSettings& settings, BinaryNode* nodes)
        : objective_(objective),
          settings_(settings),
          nodes_(nodes),
          references_(references_of(mesh)),
          right_boxes_(references_.size()),
          moved_(references_.size()),
          is_left_(references_.size()) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            orders_[axis].resize(references_.size());
            std::iota(orders_[axis].begin(), orders_[axis].end(), 0u);
            std::sort(orders_[axis].begin(), orders_[axis].end(),
                      [&](std::uint32_t a, std::uint32_t b) { return ByCenter{axis}(references_[a], references_[b]); });
        }
    }

    void build(std::uint32_t first, std::uint32_t count, std::size_t node, unsigned depth) {
        LaneBox box;
        for (std::uint32_t i = first; i < first + count; ++i) box.add(box_at(0, i));
        write_node(nodes_[node], box, first, count);
        if (count == 1) return;
        const bool must_balance = !leaves_room(depth, count - 1, settings_.most_height);
        const BestSplit split = must_balance ? halves(first, count) : best_split(first, count);
        part(first, count, split);
        build(first, split.left_count, node + 1, depth + 1);
        build(first + split.left_count, count - split.left_count, node + 1 + subtree_nodes(split.left_count),
              depth + 1);
    }

    /// Returns the triangles in the order of the tree's leaves.
    [[nodiscard]] std::vector<std::uint32_t>& triangles() { return orders_[0]; }

private:
    [[nodiscard]] LaneBox box_at(unsigned axis, std::uint32_t place) const {
        return lane_box_of(references_[orders_[axis][place]]);
    }

    [[nodiscard]] BestSplit best_split(std::uint32_t first, std::uint32_t count) {
        const auto from_middle = [&](std::uint32_t left) {
            return left < count / 2 ? count / 2 - left : left - count / 2;
        };
        const std::uint32_t fewest = objective_ == Objective::bounded_sum_of_areas ? std::max(1u, count / 3) : 1;
        BestSplit best;
        for (unsigned axis = 0; axis < 3; ++axis) {
            LaneBox right;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                right.add(box_at(axis, first + i));
                right_boxes_[i] = right;
            }
            LaneBox left;
            for (std::uint32_t i = 1; i < count; ++i) {
                left.add(box_at(axis, first + i - 1));
                if (i < fewest || count - i < fewest) continue;
                const double here = cost(objective_, {axis, left, right_boxes_[i], i, count - i});
                const bool is_nearer = here == best.cost && from_middle(i) < from_middle(best.left_count);
                if (here < best.cost || is_nearer) best = {here, axis, i};
            }
        }
        return best;
    }

    /// Returns equal numbers along the axis in which the centres spread most.
    [[nodiscard]] BestSplit halves(std::uint32_t first, std::uint32_t count) const {
        LaneBox centers;
        for (std::uint32_t i = first; i < first + count; ++i) {
            const LaneBox box = box_at(0, i);
            centers.add(box.lo + box.hi);
        }
        return {0.0, longest_side(centers), count / 2};
    }

    /// Moves what stays left to the front in the two other orders, and keeps them sorted.
    void part(std::uint32_t first, std::uint32_t count, const BestSplit& split) {
        const auto& sorted = orders_[split.axis];
        for (std::uint32_t i = 0; i < count; ++i) is_left_[sorted[first + i]] = i < split.left_count ? 1 : 0;
        for (unsigned axis = 0; axis < 3; ++axis) {
            if (axis == split.axis) continue;
            auto& order = orders_[axis];
            std::uint32_t left = first;
            std::uint32_t right = 0;
            for (std::uint32_t i = first; i < first + count; ++i) {
                const std::uint32_t triangle = order[i];
                if (is_left_[triangle] != 0) order[left++] = triangle;
                else moved_[right++] = triangle;
            }
            std::copy_n(moved_.begin(), right, order.begin() + left);
        }
    }

    Objective objective_;
    const BuildSettings& settings_;
    BinaryNode* nodes_;
    std::vector<Reference> references_;
    std::array<std::vector<std::uint32_t>, 3> orders_;
    std::vector<LaneBox> right_boxes_;
    std::vector<std::uint32_t> moved_;
    std::vector<std::uint8_t> is_left_;
};

}  // namespace

baker::BinaryTree build_by_objective(const baker::LatticeMesh& mesh, Objective objective,
                                     const baker::BuildSettings& settings) {
    BinaryTree tree;
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    if (count == 0) return tree;
    tree.nodes = std::make_unique_for_overwrite<BinaryNode[]>(subtree_nodes(count));
    ObjectiveBuilder builder(mesh, objective, settings, tree.nodes.get());
    builder.build(0, count, 0, 0);
    tree.triangles = std::move(builder.triangles());
    return tree;
}

}  // namespace espalier::bench
