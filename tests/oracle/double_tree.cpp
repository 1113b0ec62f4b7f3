#include "double_tree.hpp"

#include <limits>
#include <numeric>
#include <utility>

namespace espalier::reference {

namespace {

constexpr std::size_t leaf_size = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// Larger than the relative rounding error of a slab's interval and of an edge's sign, both about ten roundings of
/// 2^-53.
constexpr double margin = 0x1p-48;

double coordinate(Point p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

double squared_distance_to_box(Point p, Point low, Point high) {
    const Point apart = {std::max({low.x - p.x, p.x - high.x, 0.0}), std::max({low.y - p.y, p.y - high.y, 0.0}),
                         std::max({low.z - p.z, p.z - high.z, 0.0})};
    return dot(apart, apart);
}

/// Where the ray enters the box, infinity when it passes by or enters behind `limit`.
double entry(const PointRay& ray, Point inverse, Point low, Point high, double limit) {
    double enter = 0.0, leave = limit;
    for (int k = 0; k < 3; ++k) {
        const double a = (coordinate(low, k) - coordinate(ray.origin, k)) * coordinate(inverse, k);
        const double b = (coordinate(high, k) - coordinate(ray.origin, k)) * coordinate(inverse, k);
        if (std::isnan(a) || std::isnan(b)) continue;  // 0 times infinity: the ray runs within a plane of the box
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return enter * (1.0 - margin) <= leave * (1.0 + margin) ? enter : infinity;
}

/// Sides by the sign of a determinant for each edge, which neighbours compute alike: no gaps between them.
void hit_triangle(const PointRay& ray, double direction_length, const PointTriangle& triangle, std::uint32_t number,
                  ReferenceHit& best) {
    const Point a = triangle[0] - ray.origin, b = triangle[1] - ray.origin, c = triangle[2] - ray.origin;
    const double u = dot(ray.direction, cross(c, b));
    const double v = dot(ray.direction, cross(a, c));
    const double w = dot(ray.direction, cross(b, a));
    const double bound = margin * direction_length * std::max({dot(a, a), dot(b, b), dot(c, c)});
    const bool may_be_front = u >= -bound && v >= -bound && w >= -bound;
    const bool may_be_back = u <= bound && v <= bound && w <= bound;
    if (!may_be_front && !may_be_back) return;
    const bool is_inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    const double sum = u + v + w;
    const Point normal = normal_of(triangle);
    const double slope = dot(normal, ray.direction);
    if (sum == 0.0 || slope == 0.0) return;  // in the triangle's plane, or no area
    const double t = dot(normal, a) / slope;
    if (!(t >= 0.0) || t >= best.t) return;
    // a doubtful edge in front of the hit that is found in the end; one behind it is counted too
    if (std::min({std::abs(u), std::abs(v), std::abs(w)}) <= bound) best.is_doubtful = true;
    if (!is_inside) return;
    best.is_hit = true;
    best.t = t;
    best.triangle = number;
}

}  // namespace

DoubleTree::DoubleTree(std::vector<PointTriangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (!order_.empty()) build(0, order_.size());
}

DoubleTree::Box DoubleTree::box_of(std::uint32_t triangle) const {
    const PointTriangle& t = triangles_[triangle];
    return {
        {std::min({t[0].x, t[1].x, t[2].x}), std::min({t[0].y, t[1].y, t[2].y}), std::min({t[0].z, t[1].z, t[2].z})},
        {std::max({t[0].x, t[1].x, t[2].x}), std::max({t[0].y, t[1].y, t[2].y}), std::max({t[0].z, t[1].z, t[2].z})}};
}

/// Halves by the centers along the longest side: deep as the logarithm, whatever the mesh.
void DoubleTree::build(std::size_t first, std::size_t count) {
    const std::size_t number = nodes_.size();
    nodes_.emplace_back();
    Box box = box_of(order_[first]);
    for (std::size_t i = first + 1; i < first + count; ++i) {
        const Box other = box_of(order_[i]);
        box.low = {std::min(box.low.x, other.low.x), std::min(box.low.y, other.low.y),
                   std::min(box.low.z, other.low.z)};
        box.high = {std::max(box.high.x, other.high.x), std::max(box.high.y, other.high.y),
                    std::max(box.high.z, other.high.z)};
    }
    nodes_[number].box = box;
    if (count <= leaf_size) {
        nodes_[number].first = static_cast<std::uint32_t>(first);
        nodes_[number].count = static_cast<std::uint32_t>(count);
        return;
    }
    const Point size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto center = [&](std::uint32_t triangle) {
        const Box own = box_of(triangle);
        return coordinate(own.low, axis) + coordinate(own.high, axis);
    };
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t half = count / 2;
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), begin + static_cast<std::ptrdiff_t>(count),
                     [&](std::uint32_t a, std::uint32_t b) { return center(a) < center(b); });
    build(first, half);
    nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
    build(first + half, count - half);
}

ReferenceHit DoubleTree::closest_hit(const PointRay& ray) const {
    ReferenceHit best;
    best.t = infinity;
    if (nodes_.empty()) return best;
    const Point inverse = {1.0 / ray.direction.x, 1.0 / ray.direction.y, 1.0 / ray.direction.z};
    const double direction_length = length(ray.direction);
    const auto enter = [&](std::uint32_t node) {
        return entry(ray, inverse, nodes_[node].box.low, nodes_[node].box.high, best.t);
    };
    std::vector<std::pair<std::uint32_t, double>> waiting{{0, enter(0)}};
    while (!waiting.empty()) {
        const auto [number, entered] = waiting.back();
        waiting.pop_back();
        if (entered == infinity || entered * (1.0 - margin) > best.t) continue;
        const Node& node = nodes_[number];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            hit_triangle(ray, direction_length, triangles_[order_[i]], order_[i], best);
        if (node.count != 0) continue;
        const std::uint32_t near = number + 1, far = node.second;
        const double near_entry = enter(near), far_entry = enter(far);
        waiting.emplace_back(near_entry <= far_entry ? far : near, std::max(near_entry, far_entry));
        waiting.emplace_back(near_entry <= far_entry ? near : far, std::min(near_entry, far_entry));
    }
    return best;
}

ReferenceNearest DoubleTree::nearest(Point point, std::uint32_t guess) const {
    ReferenceNearest best{squared_distance(point, triangles_[guess]), guess};
    const auto distance = [&](std::uint32_t node) {
        return squared_distance_to_box(point, nodes_[node].box.low, nodes_[node].box.high);
    };
    std::vector<std::pair<std::uint32_t, double>> waiting{{0, distance(0)}};
    while (!waiting.empty()) {
        const auto [number, squared] = waiting.back();
        waiting.pop_back();
        if (squared >= best.squared_distance) continue;
        const Node& node = nodes_[number];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const double own = squared_distance(point, triangles_[order_[i]]);
            if (own < best.squared_distance) best = {own, order_[i]};
        }
        if (node.count != 0) continue;
        const std::uint32_t near = number + 1, far = node.second;
        const double near_distance = distance(near), far_distance = distance(far);
        waiting.emplace_back(near_distance <= far_distance ? far : near, std::max(near_distance, far_distance));
        waiting.emplace_back(near_distance <= far_distance ? near : far, std::min(near_distance, far_distance));
    }
    return best;
}

}  // namespace espalier::reference
