#include <baker/build/sweep.hpp>

#include "builders.hpp"

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

}  // namespace

baker::BinaryTree build_by_objective(const baker::LatticeMesh& mesh, Objective objective,
                                     const baker::BuildSettings& settings) {
    std::vector<LaneBox> right_boxes(mesh.triangles.size());
    return build_sorted(mesh, settings, [&](const SortedOrders& orders, std::uint32_t first, std::uint32_t count) {
        const auto from_middle = [&](std::uint32_t left) {
            return left < count / 2 ? count / 2 - left : left - count / 2;
        };
        const std::uint32_t fewest = objective == Objective::bounded_sum_of_areas ? std::max(1u, count / 3) : 1;
        SortedSplit best;
        double least = std::numeric_limits<double>::infinity();
        for (unsigned axis = 0; axis < 3; ++axis) {
            LaneBox right;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                right.add(orders.box_at(axis, first + i));
                right_boxes[first + i] = right;
            }
            LaneBox left;
            for (std::uint32_t i = 1; i < count; ++i) {
                left.add(orders.box_at(axis, first + i - 1));
                if (i < fewest || count - i < fewest) continue;
                const double here = cost(objective, {axis, left, right_boxes[first + i], i, count - i});
                const bool is_nearer = here == least && from_middle(i) < from_middle(best.left_count);
                if (here >= least && !is_nearer) continue;
                least = here;
                best = {axis, i};
            }
        }
        return best;
    });
}

}  // namespace espalier::bench
