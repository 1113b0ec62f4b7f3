#include "tests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace espalier::bench {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Cuts the interval of a line down to a slab.
bool cut(double origin, double speed, double lo, double hi, double& from, double& to) {
    if (speed == 0.0) return lo <= origin && origin <= hi;
    const double a = (lo - origin) / speed;
    const double b = (hi - origin) / speed;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
    return from <= to;
}

double clamped(double value, double limit) { return std::clamp(value, -limit, limit); }

/// Whether the direction separates two blocks.
bool separates(const Point& d, const Block& a, const Block& b) {
    double reach = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
        reach += a.half[k] * std::abs(dot(d, a.axes[k])) + b.half[k] * std::abs(dot(d, b.axes[k]));
    return std::abs(dot(d, b.center - a.center)) > reach * (1.0 + 1e-12);
}

bool blocks_touch(const Block& a, const Block& b) {
    for (const Point& axis : a.axes)
        if (separates(axis, a, b)) return false;
    for (const Point& axis : b.axes)
        if (separates(axis, a, b)) return false;
    for (const Point& u : a.axes)
        for (const Point& v : b.axes)
            if (separates(cross(u, v), a, b)) return false;
    return true;
}

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

std::optional<double> entry(Kind kind, const Volumes& volumes, const Line& line) {
    double from = 0.0;
    double to = infinity;
    if (kind == Kind::sphere) {
        const Point m = line.origin - volumes.ball.center;
        const double b = dot(m, line.direction);
        const double c = dot(m, m) - volumes.ball.radius * volumes.ball.radius;
        const double root = b * b - c * dot(line.direction, line.direction);
        if (root < 0.0 || (c > 0.0 && b > 0.0)) return std::nullopt;
        return std::max(0.0, (-b - std::sqrt(root)) / dot(line.direction, line.direction));
    }
    if (kind == Kind::k_dop) {
        for (std::size_t k = 0; k < slab_count; ++k) {
            const Point& d = slab_directions[k];
            if (!cut(dot(d, line.origin), dot(d, line.direction), volumes.slabs.lo[k], volumes.slabs.hi[k], from, to))
                return std::nullopt;
        }
        return from;
    }
    const Block& block = volumes.block(kind);
    for (std::size_t k = 0; k < 3; ++k) {
        const Point& d = block.axes[k];
        if (!cut(dot(d, line.origin - block.center), dot(d, line.direction), -block.half[k], block.half[k], from, to))
            return std::nullopt;
    }
    return from;
}

bool touches(Kind kind, const Volumes& volumes, const Ball& ball) {
    if (kind == Kind::sphere) {
        const Point out = ball.center - volumes.ball.center;
        const double reach = ball.radius + volumes.ball.radius;
        return dot(out, out) <= reach * reach;
    }
    if (kind == Kind::k_dop) {
        for (std::size_t k = 0; k < slab_count; ++k) {
            const Point& d = slab_directions[k];
            const double reach = ball.radius * std::sqrt(dot(d, d));
            const double at = dot(d, ball.center);
            if (at + reach < volumes.slabs.lo[k] || at - reach > volumes.slabs.hi[k]) return false;
        }
        return true;
    }
    const Block& block = volumes.block(kind);
    const Point out = ball.center - block.center;
    Point nearest = {0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k)
        nearest = nearest + clamped(dot(out, block.axes[k]), block.half[k]) * block.axes[k];
    return dot(out - nearest, out - nearest) <= ball.radius * ball.radius * (1.0 + 1e-12);
}

bool touch(Kind kind, const Volumes& a, const Volumes& b, const Pose& pose) {
    if (kind == Kind::sphere) {
        const Point out = pose(b.ball.center) - a.ball.center;
        const double reach = a.ball.radius + b.ball.radius;
        return dot(out, out) <= reach * reach;
    }
    if (kind != Kind::k_dop) {
        Block moved = b.block(kind);
        moved.center = pose(moved.center);
        for (Point& axis : moved.axes) axis = pose.turned(axis);
        return blocks_touch(a.block(kind), moved);
    }
    std::vector<Point> corners;
    for (const Point& p : b.slabs.corners) corners.push_back(pose(p));
    for (std::size_t k = 0; k < slab_count; ++k)
        if (are_apart({a.slabs.lo[k], a.slabs.hi[k]}, range_along(slab_directions[k], corners))) return false;
    for (std::size_t k = 0; k < slab_count; ++k) {
        const Point d = pose.turned(slab_directions[k]);
        const double shift = dot(d, pose.shift);
        if (are_apart({b.slabs.lo[k] + shift, b.slabs.hi[k] + shift}, range_along(d, a.slabs.corners))) return false;
    }
    return true;
}

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

}  // namespace espalier::bench
