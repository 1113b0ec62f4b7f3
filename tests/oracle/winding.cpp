#include "winding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::oracle {

namespace {

__extension__ using Wide = __int128;
using WideVector = std::array<Wide, 3>;

WholePoint minus(const WholePoint& a, const WholePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

WideVector cross(const WholePoint& a, const WholePoint& b) {
    const auto part = [&](std::size_t i, std::size_t j) { return Wide{a[i]} * b[j] - Wide{a[j]} * b[i]; };
    return {part(1, 2), part(2, 0), part(0, 1)};
}

Wide dot(const WholePoint& a, const WideVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Wide dot(const WideVector& a, const WideVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
int sign(Wide number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

WholeTriangle seen_from(const WholePoint& point, const WholeTriangle& triangle) {
    return {{minus(triangle.corner[0], point), minus(triangle.corner[1], point), minus(triangle.corner[2], point)}};
}

bool holds(const WholeTriangle& triangle, const WholePoint& point) {
    const auto [a, b, c] = seen_from(point, triangle).corner;
    const WideVector bc = cross(b, c);
    if (dot(a, bc) != 0) return false;
    const WideVector normal = cross(minus(b, a), minus(c, a));
    return dot(normal, cross(a, b)) >= 0 && dot(normal, bc) >= 0 && dot(normal, cross(c, a)) >= 0;
}

}  // namespace

bool is_on_surface(std::span<const WholeTriangle> triangles, const WholePoint& point) {
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const WholeTriangle& triangle) { return holds(triangle, point); });
}

std::optional<std::int64_t> crossings(std::span<const WholeTriangle> triangles, const WholePoint& point,
                                      const WholePoint& direction) {
    std::int64_t count = 0;
    for (const WholeTriangle& triangle : triangles) {
        const auto [a, b, c] = seen_from(point, triangle).corner;
        const WideVector ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
        const Wide past_ab = dot(direction, ab), past_bc = dot(direction, bc), past_ca = dot(direction, ca);
        const int leaves = sign(past_ab + past_bc + past_ca);  // along the normal or against it
        if (leaves == 0) return std::nullopt;
        const int height = sign(dot(a, bc));
        if (height == 0) continue;  // the line meets the plane in the point alone, which is not on the triangle
        if (past_ab == 0 || past_bc == 0 || past_ca == 0) return std::nullopt;
        if (sign(past_ab) == leaves && sign(past_bc) == leaves && sign(past_ca) == leaves && height == leaves)
            count += leaves;
    }
    return count;
}

double winding(std::span<const WholeTriangle> triangles, const WholePoint& point) {
    using Number = long double;
    Number sum = 0;
    for (const WholeTriangle& triangle : triangles) {  // Van Oosterom and Strackee 1983
        const auto [a, b, c] = seen_from(point, triangle).corner;
        const auto inner = [](const WholePoint& p, const WholePoint& q) {
            return static_cast<Number>(Wide{p[0]} * q[0] + Wide{p[1]} * q[1] + Wide{p[2]} * q[2]);
        };
        const Number la = std::sqrt(inner(a, a)), lb = std::sqrt(inner(b, b)), lc = std::sqrt(inner(c, c));
        const Number volume = static_cast<Number>(dot(a, cross(b, c)));
        const Number beside = la * lb * lc + inner(a, b) * lc + inner(b, c) * la + inner(c, a) * lb;
        // The sum above cancels and needs the digits; an angle of two numbers does not, and is faster of doubles.
        sum += static_cast<Number>(2 * std::atan2(static_cast<double>(volume), static_cast<double>(beside)));
    }
    return static_cast<double>(sum / (4 * std::numbers::pi_v<Number>));
}

}  // namespace espalier::oracle
