#include "box_trees.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "../traversal/corners.hpp"
#include "fits.hpp"

namespace espalier::bench {
namespace {

double margin_of(const AabbTree& tree) { return stored_margin_share * static_cast<double>(tree.largest); }

/// Returns the box of a node; of a leaf, the least around its triangle.
Block fit_node(std::span<const Point> corners) {
    return fit_box(corners.size() == 3 ? BoxFit::flush : BoxFit::hull, corners);
}

void store_box(const Block& box, double margin, StoredObb& to) {
    store(box.center, to.center);
    for (std::size_t k = 0; k < 3; ++k) {
        store(box.axes[k], to.axes[k]);
        to.half[k] = static_cast<float>(box.half[k] + margin);
    }
}

void store_box(const Block& box, double margin, AabbNode& to) {
    store(box.center, to.center);
    for (std::size_t k = 0; k < 3; ++k) to.half[k] = static_cast<float>(box.half[k] + margin);
}

class ObbBuilder {
public:
    explicit ObbBuilder(std::span<const FloatTriangle> triangles) {
        AabbTree& tree = built_.tree;
        tree.triangles.assign(triangles.begin(), triangles.end());
        for (const FloatTriangle& triangle : triangles)
            for (const Vec3& p : triangle)
                tree.largest = std::max({tree.largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        tree.nodes.reserve(2 * triangles.size());
        built_.boxes.reserve(2 * triangles.size());
        tree.nodes.resize(1);
        built_.boxes.resize(1);
        build(0, {0, triangles.size()}, 0);
    }
    [[nodiscard]] ObbTree take() { return std::move(built_); }

private:
    void build(std::size_t index, const TriangleRange& range, unsigned depth) {
        AabbTree& tree = built_.tree;
        tree.height = std::max(tree.height, depth);
        corners_.clear();
        for (std::size_t i = range.first; i < range.end; ++i)
            for (const Vec3& corner : tree.triangles[i]) corners_.push_back(point_of(corner));
        const Block box = fit_node(corners_);
        store_box(box, margin_of(tree), built_.boxes[index].volume);
        store_box(box_along(Block{}.axes, corners_), margin_of(tree), tree.nodes[index]);
        const bool is_leaf = range.end - range.first == 1;
        const auto first = static_cast<std::uint32_t>(is_leaf ? range.first : tree.nodes.size());
        tree.nodes[index].first = built_.boxes[index].first = first;
        tree.nodes[index].count = built_.boxes[index].count = is_leaf ? 1 : 0;
        if (is_leaf) return;
        const std::size_t middle = divide(range, box);
        tree.nodes.resize(tree.nodes.size() + 2);
        built_.boxes.resize(tree.nodes.size());
        build(first, {range.first, middle}, depth + 1);
        build(first + 1, {middle, range.end}, depth + 1);
    }
    /// Reorders the triangles and returns where those of the second child begin.
    std::size_t divide(const TriangleRange& range, const Block& box) {
        Point mean = {0.0, 0.0, 0.0};
        for (const Point& corner : corners_) mean = mean + corner;
        mean = (1.0 / static_cast<double>(corners_.size())) * mean;
        std::array<std::size_t, 3> order = {0, 1, 2};
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return box.half[a] > box.half[b]; });
        const auto begin = built_.tree.triangles.begin();
        const auto first = begin + static_cast<std::ptrdiff_t>(range.first),
                   end = begin + static_cast<std::ptrdiff_t>(range.end);
        for (const std::size_t axis : order) {
            const double plane = 3.0 * dot(box.axes[axis], mean);
            const auto middle = std::stable_partition(first, end, [&](const FloatTriangle& t) {
                return dot(box.axes[axis], point_of(t[0]) + point_of(t[1]) + point_of(t[2])) < plane;
            });
            if (middle != first && middle != end) return static_cast<std::size_t>(middle - begin);
        }
        return (range.first + range.end) / 2;
    }

    ObbTree built_;
    std::vector<Point> corners_;
};

}  // namespace

std::vector<TriangleRange> triangle_ranges(const AabbTree& tree) {
    // Children come after their parent, so that their ranges are there when its own is joined.
    std::vector<TriangleRange> ranges(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const AabbNode& node = tree.nodes[i];
        if (node.is_leaf()) ranges[i] = {node.first, std::size_t{node.first} + node.count};
        else ranges[i] = {ranges[node.first].first, ranges[node.first + 1].end};
    }
    return ranges;
}

ObbTree build_obb_tree(std::span<const FloatTriangle> triangles) { return ObbBuilder(triangles).take(); }

BoxNodes<StoredObb> fit_obbs(const AabbTree& tree) {
    BoxNodes<StoredObb> boxes(tree.nodes.size());
    const std::vector<TriangleRange> ranges = triangle_ranges(tree);
    std::vector<Point> corners;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        corners.clear();
        for (std::size_t t = ranges[i].first; t < ranges[i].end; ++t)
            for (const Vec3& corner : tree.triangles[t]) corners.push_back(point_of(corner));
        store_box(fit_node(corners), margin_of(tree), boxes[i].volume);
        boxes[i].first = tree.nodes[i].first;
        boxes[i].count = tree.nodes[i].count;
    }
    return boxes;
}

BoxNodes<StoredAabb> copy_aabbs(const AabbTree& tree) {
    BoxNodes<StoredAabb> boxes(tree.nodes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const AabbNode& node = tree.nodes[i];
        std::copy_n(node.center, 3, boxes[i].volume.center);
        std::copy_n(node.half, 3, boxes[i].volume.half);
        boxes[i].first = node.first;
        boxes[i].count = node.count;
    }
    return boxes;
}

}  // namespace espalier::bench
