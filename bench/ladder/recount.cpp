#include "systems.hpp"

#include "../study/aabb_tree.hpp"

namespace espalier::bench {
namespace {

constexpr float never = std::numeric_limits<float>::infinity();

/// An interval of t.
struct Interval {
    float begin, end;
    [[nodiscard]] bool meets(const Interval& other) const { return !(end < other.begin) && !(other.end < begin); }
};

/// Returns t where the ray enters the range, or infinity. The slabs have a point of the ray in common if and only if
/// each two of them have one (Helly's theorem, for intervals).
float entry_of(const Ray& ray, const float* low, const float* high) {
    const float from[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    const float along[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
    Interval slabs[4] = {{0.0f, never}, {}, {}, {}};
    for (int k = 0; k < 3; ++k) {
        float slope = along[k];
        if (std::fabs(slope) < 1e-18f) slope = std::signbit(slope) ? -1e-18f : 1e-18f;
        const float per_unit = 1.0f / slope;
        const float at_low = (low[k] - from[k]) * per_unit, at_high = (high[k] - from[k]) * per_unit;
        slabs[k + 1] = per_unit > 0.0f ? Interval{at_low, at_high} : Interval{at_high, at_low};
    }
    float entry = 0.0f;
    for (const Interval& a : slabs) {
        for (const Interval& b : slabs)
            if (!a.meets(b)) return never;
        if (a.begin > entry) entry = a.begin;
    }
    return entry;
}

}  // namespace

std::vector<TriangleOnRay> triangles_on(const Ray& ray, const Mesh& mesh) {
    const Line line = {point_of(ray.origin), point_of(ray.direction)};
    std::vector<TriangleOnRay> found;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        Corners3 corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = point_of(mesh.positions[mesh.triangles[i][k]]);
        if (const auto at = meets(corners, line)) found.push_back({i, static_cast<float>(*at)});
    }
    return found;
}

Recount::Recount(const TreeShape& shape, StoredBoxes stored, const Mesh& mesh, float margin)
    : shape_(&shape), stored_(stored), leaf_of_triangle_(mesh.triangles.size()) {
    constexpr Range empty = {{never, never, never}, {-never, -never, -never}};
    ranges_.assign(shape.nodes.size(), empty);
    const auto grow = [](Range& range, int k, float low, float high) {
        if (low < range.low[k]) range.low[k] = low;
        if (high > range.high[k]) range.high[k] = high;
    };
    for (std::uint32_t i = 0; i < shape.nodes.size(); ++i) {
        if (!shape.nodes[i].is_leaf()) continue;
        for (std::uint32_t t = shape.nodes[i].first; t < shape.nodes[i].first + shape.nodes[i].count; ++t) {
            leaf_of_triangle_[t] = i;
            for (const std::uint32_t vertex : mesh.triangles[t]) {
                const Vec3& p = mesh.positions[vertex];
                const float at[3] = {p.x, p.y, p.z};
                for (int k = 0; k < 3; ++k) grow(ranges_[i], k, at[k] - margin, at[k] + margin);
            }
        }
    }
    for (std::size_t i = shape.nodes.size(); i-- > 1;)
        for (int k = 0; k < 3; ++k) grow(ranges_[shape.nodes[i].parent], k, ranges_[i].low[k], ranges_[i].high[k]);
    if (stored.quantised) round_outward();
}

/// Rounds all ranges outward to the least power of two of which 65,534 reach over the root's largest side.
void Recount::round_outward() {
    const Range root = ranges_[0];
    double side = 0.0, step = 0x1p-120;
    for (int k = 0; k < 3; ++k) side = std::fmax(side, double(root.high[k] - root.low[k]));
    while (65534.0 * step < side) step *= 2.0;
    for (Range& range : ranges_)
        for (int k = 0; k < 3; ++k) {
            range.low[k] = static_cast<float>(step * std::floor(double(range.low[k]) / step));
            range.high[k] = static_cast<float>(step * std::ceil(double(range.high[k]) / step));
        }
}

bool Recount::has_box(std::size_t node) const { return stored_.of_leaves || !shape_->nodes[node].is_leaf(); }

/// Counts tests of the root's box and of the boxes of a visited node's children.
TreeWork Recount::work_of(const std::vector<char>& is_visited) const {
    TreeWork work;
    for (std::size_t i = 0; i < shape_->nodes.size(); ++i) {
        const ShapeNode& node = shape_->nodes[i];
        if (has_box(i) && (i == 0 || is_visited[node.parent])) work.box_tests += 1;
        if (!is_visited[i]) continue;
        work.nodes += node.is_leaf() ? 0u : 1u;
        work.leaves += node.is_leaf() ? 1u : 0u;
        work.triangle_tests += node.is_leaf() ? node.count : 0;
    }
    return work;
}

TreeWork Recount::closest(const Ray& ray, std::span<const TriangleOnRay> hits) const {
    const std::vector<ShapeNode>& nodes = shape_->nodes;
    // Where the ray enters each node whose ancestors it meets, and how many triangles come before it in the ray's
    // order.
    std::vector<float> entry(nodes.size(), never);
    std::vector<std::uint32_t> before(nodes.size(), 0);
    entry[0] = entry_of(ray, ranges_[0].low, ranges_[0].high);
    std::vector<std::uint32_t> order;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (entry[i] == never || nodes[i].is_leaf()) continue;
        order.clear();
        for (std::uint32_t child = nodes[i].first_child; child < nodes[i].first_child + nodes[i].child_count; ++child) {
            // -1 for leaves without a box: they come first, and are visited with their parent.
            entry[child] = has_box(child) ? entry_of(ray, ranges_[child].low, ranges_[child].high) : -1.0f;
            order.push_back(child);
        }
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return entry[a] < entry[b]; });
        std::uint32_t sum = before[i];
        for (const std::uint32_t child : order) {
            before[child] = sum;
            sum += nodes[child].count;
        }
    }
    std::vector<char> is_visited(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (entry[i] == never || (i > 0 && !is_visited[nodes[i].parent])) continue;
        float nearest = never;
        for (const TriangleOnRay& hit : hits)
            if (before[leaf_of_triangle_[hit.triangle]] < before[i]) nearest = std::min(nearest, hit.t);
        is_visited[i] = entry[i] <= nearest ? 1 : 0;
    }
    return work_of(is_visited);
}

TreeWork Recount::touching(const Aabb& box) const {
    const std::vector<ShapeNode>& nodes = shape_->nodes;
    std::vector<char> is_visited(nodes.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i > 0 && !is_visited[nodes[i].parent]) continue;
        bool have_common_points = true;
        for (std::size_t k = 0; k < 3 && has_box(i); ++k)
            have_common_points &=
                std::fmax(box.low[k], ranges_[i].low[int(k)]) <= std::fmin(box.high[k], ranges_[i].high[int(k)]);
        is_visited[i] = have_common_points ? 1 : 0;
    }
    return work_of(is_visited);
}

}  // namespace espalier::bench
