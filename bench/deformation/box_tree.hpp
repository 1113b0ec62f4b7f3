// A binary tree over the triangles of a mesh, with one triangle in each leaf, as the textbook has it: a shape, and
// boxes of two kinds over it. Axis-aligned boxes (AABB) are renewed from the bottom up (van den Bergen 1997); oriented
// boxes (OBB) are fitted anew to all triangles of each node.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

/// Which triangles are in which node.
struct BoxTreeShape {
    struct Node {
        std::uint32_t right;  ///< the number of the second child; the first follows the node. 0: a leaf
        std::uint32_t first;  ///< in `triangles`
        std::uint32_t count;
    };
    std::vector<Node> nodes;  ///< children come after their parents
    std::vector<TriangleVertices> triangles;

    [[nodiscard]] std::span<const TriangleVertices> triangles_of(const Node& node) const {
        return std::span(triangles).subspan(node.first, node.count);
    }
};

/// Splits boxes at the best of 16 bins along each axis, by the middles of the boxes (surface area heuristic);
/// `weight(n)` is what n boxes count for. Reorders the numbers of the boxes, and returns how many of them come first.
template <class Number, class Weight>
std::size_t split_by_areas(std::span<Number> numbers, std::span<const Aabb> boxes_of, const Weight& weight) {
    constexpr std::size_t bins = 16;
    const auto middle = [&](Number number, std::size_t k) {
        return 0.5f * (boxes_of[number].low[k] + boxes_of[number].high[k]);
    };
    Aabb middles = Aabb::none();
    for (const Number number : numbers) middles.add(Vec3{middle(number, 0), middle(number, 1), middle(number, 2)});
    const auto bin_of = [&](Number number, std::size_t k) {
        const float share = (middle(number, k) - middles.low[k]) / (middles.high[k] - middles.low[k]);
        return std::min(bins - 1, static_cast<std::size_t>(share * static_cast<float>(bins)));
    };
    double least = std::numeric_limits<double>::infinity();
    std::size_t best_axis = 0, best_bin = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(middles.high[axis] > middles.low[axis])) continue;
        std::array<Aabb, bins> boxes;
        boxes.fill(Aabb::none());
        std::array<std::size_t, bins> count{};
        for (const Number number : numbers) {
            const std::size_t bin = bin_of(number, axis);
            boxes[bin].add(boxes_of[number]);
            ++count[bin];
        }
        std::array<double, bins> behind{};
        Aabb right = Aabb::none();
        for (std::size_t bin = bins, sum = 0; bin-- > 1;) {
            right.add(boxes[bin]);
            behind[bin] = right.half_area() * weight(sum += count[bin]);
        }
        Aabb left = Aabb::none();
        for (std::size_t bin = 1, sum = 0; bin < bins; ++bin) {
            left.add(boxes[bin - 1]);
            sum += count[bin - 1];
            const double cost = left.half_area() * weight(sum) + behind[bin];
            if (sum == 0 || sum == numbers.size() || cost >= least) continue;
            least = cost;
            best_axis = axis;
            best_bin = bin;
        }
    }
    if (best_bin == 0) return numbers.size() / 2;  // all middles are at one point
    const auto end = std::partition(numbers.begin(), numbers.end(),
                                    [&](Number number) { return bin_of(number, best_axis) < best_bin; });
    return static_cast<std::size_t>(end - numbers.begin());
}

/// Builds from the top down: a node is split at the best of 16 bins along each axis (surface area heuristic).
BoxTreeShape build_box_tree(std::span<const TriangleVertices> triangles, std::span<const Vec3> positions);

struct Obb {
    std::array<Vec3, 3> axes;        ///< of length 1, perpendicular
    std::array<float, 3> low, high;  ///< along the axes

    [[nodiscard]] bool contains(const Vec3& point, float rounding) const;
    [[nodiscard]] double half_area() const;
};

/// Renews the boxes of all nodes; `boxes` has as many.
void refit_aabbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Aabb> boxes);

/// Fits a box to the vertices of each node: axes are the eigenvectors of their covariance (Gottschalk, Lin, Manocha
/// 1996); of a leaf, its longest edge and its normal.
void fit_obbs(const BoxTreeShape& shape, std::span<const Vec3> positions, std::span<Obb> boxes);

/// Returns the sum of half the areas of all boxes.
template <class Boxes>
double total_half_area(const Boxes& boxes) {
    double sum = 0.0;
    for (const auto& box : boxes) sum += box.half_area();
    return sum;
}

}  // namespace espalier::bench
