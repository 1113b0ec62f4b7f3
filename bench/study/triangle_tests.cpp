#include "shapes.hpp"

namespace espalier::bench {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Range {
    double lo = infinity;
    double hi = -infinity;
};

template <class Points>
Range range_along(const Point& d, const Points& points) {
    Range range;
    for (const Point& p : points) {
        range.lo = std::min(range.lo, dot(d, p));
        range.hi = std::max(range.hi, dot(d, p));
    }
    return range;
}

bool are_apart(const Range& a, const Range& b) { return a.hi < b.lo || b.hi < a.lo; }

}  // namespace

std::optional<double> meets(const Corners3& t, const Line& line) {  // Möller, Trumbore 1997
    const Point ab = t[1] - t[0];
    const Point ac = t[2] - t[0];
    const Point p = cross(line.direction, ac);
    const double volume = dot(ab, p);
    if (volume == 0.0) return std::nullopt;
    const Point s = line.origin - t[0];
    const double u = dot(s, p) / volume;
    const Point q = cross(s, ab);
    const double v = dot(line.direction, q) / volume;
    const double at = dot(ac, q) / volume;
    if (u < 0.0 || v < 0.0 || u + v > 1.0 || at < 0.0) return std::nullopt;
    return at;
}

bool touches(const Corners3& t, const Ball& ball) {
    double least = infinity;
    const Point normal = cross(t[1] - t[0], t[2] - t[0]);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const Point side = t[(k + 1) % 3] - t[k];
        const Point out = ball.center - t[k];
        inside &= dot(cross(side, out), normal) >= 0.0;
        const Point rest = out - std::clamp(dot(out, side) / dot(side, side), 0.0, 1.0) * side;
        least = std::min(least, dot(rest, rest));
    }
    if (inside) {
        const double height = dot(normal, ball.center - t[0]);
        least = std::min(least, height * height / dot(normal, normal));
    }
    return least <= ball.radius * ball.radius;
}

bool touch(const Corners3& a, const Corners3& b) {  // by all separating axes, those of coplanar triangles too
    const auto apart = [&](const Point& d) { return are_apart(range_along(d, a), range_along(d, b)); };
    const Point normal_a = cross(a[1] - a[0], a[2] - a[0]);
    const Point normal_b = cross(b[1] - b[0], b[2] - b[0]);
    if (apart(normal_a) || apart(normal_b)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point side_a = a[(i + 1) % 3] - a[i];
        const Point side_b = b[(i + 1) % 3] - b[i];
        if (apart(cross(normal_a, side_a)) || apart(cross(normal_b, side_b))) return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (apart(cross(side_a, b[(k + 1) % 3] - b[k]))) return false;
    }
    return true;
}

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
