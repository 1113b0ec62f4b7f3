// With X seen from the apex, s = axis . X and h = axis . axis, a point is in the cone when 0 <= s <= h and
//   F(X) = (radius^2 + h) s^2 - h^2 X . X >= 0.
// A triangle is a + u ab + v ac. What is left of it between the planes s = 0 and s = h is a convex polygon in u and v.
// F is a quadratic function there: it is largest at a corner of the polygon, where its derivative along an edge is
// zero, or where its gradient is zero.
#include "cone.hpp"

#include <vector>

namespace espalier::oracle {

namespace {

/// Weights of the triangle's sides ab and ac.
using Weights = std::array<Rational, 2>;

Weights between(const Weights& from, const Weights& to, const Rational& t) {
    return {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
}

/// A linear function of the weights.
struct Linear {
    Rational whole, u, v;
    Rational operator()(const Weights& at) const { return whole + u * at[0] + v * at[1]; }
};

/// The part of the polygon where the function is not negative.
std::vector<Weights> clipped(const std::vector<Weights>& polygon, const Linear& inside) {
    std::vector<Weights> rest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Weights& from = polygon[i];
        const Weights& to = polygon[(i + 1) % polygon.size()];
        const Rational at_from = inside(from), at_to = inside(to);
        if (at_from.sign() >= 0) rest.push_back(from);
        if (at_from.sign() * at_to.sign() < 0) rest.push_back(between(from, to, at_from / (at_from - at_to)));
    }
    return rest;
}

/// A quadratic function of the weights.
struct Quadratic {
    Rational whole, u, v, uu, uv, vv;

    Rational operator()(const Weights& at) const {
        return whole + at[0] * (u + uu * at[0] + uv * at[1]) + at[1] * (v + vv * at[1]);
    }
    /// Where its gradient is zero, if that is one point.
    [[nodiscard]] std::optional<Weights> center() const {
        const Rational determinant = 4 * uu * vv - uv * uv;
        if (determinant.sign() == 0) return std::nullopt;
        return Weights{(uv * v - 2 * vv * u) / determinant, (uv * u - 2 * uu * v) / determinant};
    }
    /// Where its derivative is zero between two points, if that is one point.
    [[nodiscard]] std::optional<Weights> middle(const Weights& from, const Weights& to) const {
        const Rational at_from = (*this)(from), at_half = (*this)(between(from, to, Rational::of(1, -1)));
        const Rational at_to = (*this)(to);
        const Rational bend = 2 * (at_from - 2 * at_half + at_to), slope = 4 * at_half - 3 * at_from - at_to;
        if (bend.sign() == 0) return std::nullopt;
        const Rational t = -slope / (2 * bend);
        if (t.sign() < 0 || (1 - t).sign() < 0) return std::nullopt;
        return between(from, to, t);
    }
};

}  // namespace

bool meets(const Cone& cone, const Triangle& triangle) {
    const Point a = triangle.a - cone.apex, ab = triangle.b - triangle.a, ac = triangle.c - triangle.a;
    const Rational h = cone.axis.dot(cone.axis);
    const Linear low = {cone.axis.dot(a), cone.axis.dot(ab), cone.axis.dot(ac)};
    const Linear high = {h - low.whole, -low.u, -low.v};
    const std::vector<Weights> all = {{0, 0}, {1, 0}, {0, 1}};
    const std::vector<Weights> polygon = clipped(clipped(all, low), high);
    const auto form = [&](const Point& p, const Point& q) -> Rational {
        return (cone.radius * cone.radius + h) * cone.axis.dot(p) * cone.axis.dot(q) - h * h * p.dot(q);
    };
    const Quadratic inside = {form(a, a),   2 * form(a, ab),  2 * form(a, ac),
                              form(ab, ab), 2 * form(ab, ac), form(ac, ac)};
    for (const Weights& corner : polygon)
        if (inside(corner).sign() >= 0) return true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto middle = inside.middle(polygon[i], polygon[(i + 1) % polygon.size()]);
        if (middle && inside(*middle).sign() >= 0) return true;
    }
    const auto center = inside.center();
    if (!center) return false;
    const auto& [u, v] = *center;
    return u.sign() >= 0 && v.sign() >= 0 && (1 - u - v).sign() >= 0 && low(*center).sign() >= 0 &&
           high(*center).sign() >= 0 && inside(*center).sign() >= 0;
}

}  // namespace espalier::oracle
