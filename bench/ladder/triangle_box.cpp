#include "triangle_box.hpp"

#include <algorithm>
#include <cmath>

namespace espalier::bench {
namespace {

/// Returns whether the box around the origin and the triangle are on different sides of a plane across `axis`.
bool are_apart(const Point& axis, const Point& half, const Corners3& t) {
    const double reach = half.x * std::abs(axis.x) + half.y * std::abs(axis.y) + half.z * std::abs(axis.z);
    const double a = dot(axis, t[0]), b = dot(axis, t[1]), c = dot(axis, t[2]);
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

}  // namespace

TriangleBoxTest::TriangleBoxTest(const Aabb& box) {
    const auto middle = [&](std::size_t k) { return 0.5 * (double(box.low[k]) + double(box.high[k])); };
    const auto half = [&](std::size_t k) { return 0.5 * (double(box.high[k]) - double(box.low[k])); };
    center_ = {middle(0), middle(1), middle(2)};
    half_ = {half(0), half(1), half(2)};
}

bool TriangleBoxTest::touches(const Corners3& triangle) const {
    const Corners3 t = {triangle[0] - center_, triangle[1] - center_, triangle[2] - center_};
    const auto is_beside = [](double a, double b, double c, double half) {
        return std::min({a, b, c}) > half || std::max({a, b, c}) < -half;
    };
    if (is_beside(t[0].x, t[1].x, t[2].x, half_.x) || is_beside(t[0].y, t[1].y, t[2].y, half_.y) ||
        is_beside(t[0].z, t[1].z, t[2].z, half_.z))
        return false;
    const Point edges[3] = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    if (are_apart(cross(edges[0], edges[1]), half_, t)) return false;
    for (const Point& e : edges)  // cross products with the axes x, y and z
        if (are_apart({0.0, -e.z, e.y}, half_, t) || are_apart({e.z, 0.0, -e.x}, half_, t) ||
            are_apart({-e.y, e.x, 0.0}, half_, t))
            return false;
    return true;
}

}  // namespace espalier::bench
