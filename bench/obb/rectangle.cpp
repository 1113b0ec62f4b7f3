#include "rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace espalier::bench {
namespace {

double turn(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// Drops corners that are so close to the one before that the direction between them is made of rounding.
void drop_short_edges(std::vector<PlanePoint>& polygon) {
    constexpr double shortest_share = 0x1p-40;
    double size = 0.0;
    for (const PlanePoint& p : polygon) size = std::max(size, distance(polygon.front(), p));
    const auto is_short = [&](const PlanePoint& a, const PlanePoint& b) {
        return distance(a, b) <= shortest_share * size;
    };
    polygon.erase(std::unique(polygon.begin(), polygon.end(), is_short), polygon.end());
    while (polygon.size() > 1 && is_short(polygon.back(), polygon.front())) polygon.pop_back();
}

}  // namespace

void reduce_to_polygon(std::vector<PlanePoint>& points) {
    std::sort(points.begin(), points.end(), [](const PlanePoint& a, const PlanePoint& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.number < b.number;
    });
    const auto is_same_place = [](const PlanePoint& a, const PlanePoint& b) { return a.x == b.x && a.y == b.y; };
    points.erase(std::unique(points.begin(), points.end(), is_same_place), points.end());
    if (points.size() < 3) return drop_short_edges(points);
    std::vector<PlanePoint> chain;
    chain.reserve(points.size() + 1);
    const auto extend = [&](const PlanePoint& p, std::size_t begin) {
        while (chain.size() >= begin + 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0.0) chain.pop_back();
        chain.push_back(p);
    };
    for (const PlanePoint& p : points) extend(p, 0);  // from below
    const std::size_t begin = chain.size() - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], begin);
    chain.pop_back();  // the first one again
    points = std::move(chain);
    drop_short_edges(points);
}

void find_rectangles(std::span<const PlanePoint> polygon, std::vector<Rectangle>& rectangles) {
    rectangles.clear();
    const std::size_t count = polygon.size();
    if (count < 2) rectangles.push_back({{1.0, 0.0}, 0.0, 0.0});
    if (count < 2) return;
    // The corners that are the farthest to the right of the edge's direction, above the edge, and to the left.
    std::size_t right = 1, top = 1, left = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const PlanePoint& from = polygon[i];
        const PlanePoint& to = polygon[(i + 1) % count];
        const double length = distance(from, to);
        const double x = (to.x - from.x) / length, y = (to.y - from.y) / length;
        const auto along = [&](std::size_t k) { return x * polygon[k % count].x + y * polygon[k % count].y; };
        const auto above = [&](std::size_t k) { return x * polygon[k % count].y - y * polygon[k % count].x; };
        // No caliper goes farther than one time around.
        right = std::max(right, i + 1);
        while (right < i + count && along(right + 1) > along(right)) ++right;
        top = std::max(top, right);
        while (top < i + count && above(top + 1) > above(top)) ++top;
        left = std::max(left, top);
        while (left < i + count && along(left + 1) < along(left)) ++left;
        rectangles.push_back({{x, y}, along(right) - along(left), above(top) - above(i)});
    }
}

}  // namespace espalier::bench
