#include "lattice_sides.hpp"

#include <cmath>
#include <cstdint>

namespace espalier::bench {
namespace {

__extension__ using Wide = __int128;

Wide product(double a, double b) { return Wide{static_cast<std::int64_t>(a)} * static_cast<std::int64_t>(b); }

/// The differences of lattice points have 41 bits with the sign, so the sum of six products of three has less than 128.
Wide exact_determinant(const Point& u, const Point& v, const Point& w) {
    const Wide x = product(u.y, v.z) - product(u.z, v.y), y = product(u.z, v.x) - product(u.x, v.z),
               z = product(u.x, v.y) - product(u.y, v.x);
    return x * static_cast<std::int64_t>(w.x) + y * static_cast<std::int64_t>(w.y) + z * static_cast<std::int64_t>(w.z);
}

}  // namespace

double side_of(const Point& a, const Point& b, const Point& c, const Point& p) {
    const Point u = b - a, v = c - a, w = p - a;  // exact
    const double determinant = dot(cross(u, v), w);
    const auto magnitude = [](const Point& d) { return Point{std::abs(d.x), std::abs(d.y), std::abs(d.z)}; };
    const Point mu = magnitude(u), mv = magnitude(v), mw = magnitude(w);
    const double sum =
        (mu.y * mv.z + mu.z * mv.y) * mw.x + (mu.z * mv.x + mu.x * mv.z) * mw.y + (mu.x * mv.y + mu.y * mv.x) * mw.z;
    if (std::abs(determinant) > 0x1p-49 * sum) return determinant;  // Shewchuk 1997: less than 8 roundings of 2^-53
    const Wide exact = exact_determinant(u, v, w);
    return exact > 0 ? 1.0 : exact < 0 ? -1.0 : 0.0;
}

}  // namespace espalier::bench
