#include "placed_triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "corners.hpp"

namespace espalier::bench {
namespace {

using Heights = std::array<double, 3>;

/// More than the share of the largest coordinate that double rounds off in a height.
constexpr double rounding_share = 0x1p-46;

double length_of(const Point& normal) { return std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z); }

Point normal_of(const Corners3& t) { return cross(t[1] - t[0], t[2] - t[0]); }

Heights heights_above(const Point& normal, double plane, const Corners3& corners) {
    return {dot(normal, corners[0]) - plane, dot(normal, corners[1]) - plane, dot(normal, corners[2]) - plane};
}

bool are_on_one_side(const Heights& heights, double slack) {
    return std::min({heights[0], heights[1], heights[2]}) > slack ||
           std::max({heights[0], heights[1], heights[2]}) < -slack;
}

bool is_one_uncertain(const Heights& heights, double slack) {
    return std::min({std::abs(heights[0]), std::abs(heights[1]), std::abs(heights[2])}) <= slack;
}

/// Returns the corner whose height has another sign than those of the other two.
std::size_t corner_alone(const Heights& heights) {
    const bool is_0_above = heights[0] > 0.0, is_1_above = heights[1] > 0.0, is_2_above = heights[2] > 0.0;
    if (is_1_above == is_2_above) return 0;
    return is_0_above == is_2_above ? 1 : 2;
}

Corners3 turned_to(std::size_t first, const Corners3& t) { return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]}; }

/// Tests two triangles that cross each other's planes: the segments in which they meet the common line of the planes.
bool do_segments_touch(Corners3 p, const Heights& of_p, Corners3 q, const Heights& of_q) {
    const std::size_t p_alone = corner_alone(of_p), q_alone = corner_alone(of_q);
    p = turned_to(p_alone, p);
    q = turned_to(q_alone, q);
    if (of_p[p_alone] < 0.0) std::swap(q[1], q[2]);
    if (of_q[q_alone] < 0.0) std::swap(p[1], p[2]);
    if (dot(q[1] - p[1], cross(q[0] - p[1], p[0] - p[1])) > 0.0) return false;
    return dot(q[2] - p[0], cross(q[0] - p[0], p[2] - p[0])) <= 0.0;
}

}  // namespace

PlacedTriangle::PlacedTriangle(const FloatTriangle& triangle, const Pose& pose, double largest)
    : corners_(corners_of(triangle)), rounding_(rounding_share * largest) {
    for (Point& corner : corners_) corner = pose(corner);
    normal_ = normal_of(corners_);
    height_ = dot(normal_, corners_[0]);
    slack_ = rounding_ * length_of(normal_);
}

bool PlacedTriangle::touches(const FloatTriangle& triangle) const {
    const Corners3 other = corners_of(triangle);
    const Heights of_other = heights_above(normal_, height_, other);
    if (are_on_one_side(of_other, slack_)) return false;
    const Point normal = normal_of(other);
    const Heights of_this = heights_above(normal, dot(normal, other[0]), corners_);
    const double other_slack = rounding_ * length_of(normal);
    if (are_on_one_side(of_this, other_slack)) return false;
    if (is_one_uncertain(of_other, slack_) || is_one_uncertain(of_this, other_slack)) return touch(other, corners_);
    return do_segments_touch(other, of_other, corners_, of_this);
}

}  // namespace espalier::bench
