// Whether the origin lies in the convex hull of points in space, in exact arithmetic of any kind of whole numbers.
// Carathéodory (1907): it does exactly when it lies in the hull of at most four of them that have one of their own
// dimension, and for points, segments, triangles and tetrahedra that is a matter of signs.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace espalier::oracle {

template <class Number>
using WholePoint = std::array<Number, 3>;

namespace hull {

template <class Number>
int sign_of(const Number& a) {
    return a < Number(0) ? -1 : Number(0) < a ? 1 : 0;
}
template <class Number>
Number inner(const WholePoint<Number>& a, const WholePoint<Number>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
WholePoint<Number> outer(const WholePoint<Number>& a, const WholePoint<Number>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
bool is_zero(const WholePoint<Number>& a) {
    return sign_of(a[0]) == 0 && sign_of(a[1]) == 0 && sign_of(a[2]) == 0;
}

}  // namespace hull

template <class Number>
bool hull_has_origin(const std::vector<WholePoint<Number>>& points) {
    using namespace hull;
    const std::size_t count = points.size();
    // The sign of the determinant of any three: positive when they go round counterclockwise, seen from the origin.
    std::vector<int> signs(count * count * count);
    const auto sign = [&](std::size_t i, std::size_t j, std::size_t k) -> int& {
        return signs[(i * count + j) * count + k];
    };
    for (std::size_t i = 0; i < count; ++i) {
        if (is_zero(points[i])) return true;
        for (std::size_t j = i + 1; j < count; ++j) {
            const WholePoint<Number> ij = outer(points[i], points[j]);
            if (is_zero(ij) && sign_of(inner(points[i], points[j])) < 0) return true;
            for (std::size_t k = j + 1; k < count; ++k) {
                sign(i, j, k) = sign_of(inner(ij, points[k]));
                if (sign(i, j, k) != 0) continue;
                // In one plane with the origin: it is inside when all turn the same way about it.
                const WholePoint<Number> jk = outer(points[j], points[k]);
                const WholePoint<Number> ki = outer(points[k], points[i]);
                WholePoint<Number> normal;
                for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] = ij[axis] + jk[axis] + ki[axis];
                if (!is_zero(normal) && sign_of(inner(ij, normal)) >= 0 && sign_of(inner(jk, normal)) >= 0 &&
                    sign_of(inner(ki, normal)) >= 0)
                    return true;
            }
        }
    }
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j)
            for (std::size_t k = j + 1; k < count; ++k)
                for (std::size_t l = k + 1; l < count; ++l) {
                    const std::array<int, 4> faces = {sign(j, k, l), -sign(i, k, l), sign(i, j, l), -sign(i, j, k)};
                    bool above = false;
                    bool below = false;
                    for (const int face : faces) {
                        above = above || face > 0;
                        below = below || face < 0;
                    }
                    if (above != below) return true;
                }
    return false;
}

/// Whether the hulls of two sets of points share a point: whether their differences reach the origin.
template <class Number>
bool hulls_meet(const std::vector<WholePoint<Number>>& a, const std::vector<WholePoint<Number>>& b) {
    std::vector<WholePoint<Number>> differences;
    for (const auto& p : a)
        for (const auto& q : b) differences.push_back({p[0] - q[0], p[1] - q[1], p[2] - q[2]});
    return hull_has_origin(differences);
}

}  // namespace espalier::oracle
