// Whether the origin lies in the convex hull of points in space, and where a line meets that hull, in exact arithmetic
// of any kind of whole numbers.
// Carathéodory (1907): it does exactly when it lies in the hull of at most four of them that have one of their own
// dimension, and for points, segments, triangles and tetrahedra that is a matter of signs.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
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
                    bool above = false, below = false;
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

/// A quotient of whole numbers.
template <class Number>
struct Quotient {
    Number numerator;
    Number denominator;  ///< above 0
};
template <class Number>
bool is_less(const Quotient<Number>& a, const Quotient<Number>& b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
}

/// The least t for which t * way lies in the convex hull of points, if any does. That is where the line meets a face,
/// hence a triangle, a segment or a point of points: tries all.
template <class Number>
std::optional<Quotient<Number>> line_enters_hull(const std::vector<WholePoint<Number>>& points,
                                                 const WholePoint<Number>& way) {
    using namespace hull;
    std::optional<Quotient<Number>> least;
    const auto offer = [&](const Number& numerator, const Number& denominator) {
        const Quotient<Number> t = {numerator, denominator};
        if (!least || is_less(t, *least)) least = t;
    };
    const std::size_t count = points.size();
    const Number squared_way = inner(way, way);
    std::vector<WholePoint<Number>> beside;  // each point's moment about the line
    for (const auto& point : points) {
        beside.push_back(outer(way, point));
        if (is_zero(beside.back())) offer(inner(point, way), squared_way);
    }
    std::vector<Number> turns(count * count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j) turns[i * count + j] = inner(beside[i], points[j]);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = i + 1; j < count; ++j) {
            const Number ij = turns[i * count + j];
            if (sign_of(ij) == 0 && sign_of(inner(beside[i], beside[j])) < 0) {
                // Opposite each other: weighted by how far the other one is from the line.
                const Number of_i = -inner(beside[i], beside[j]), of_j = inner(beside[i], beside[i]);
                offer(of_i * inner(points[i], way) + of_j * inner(points[j], way), (of_i + of_j) * squared_way);
            }
            const WholePoint<Number> product = outer(points[i], points[j]);
            for (std::size_t k = j + 1; k < count; ++k) {
                const Number jk = turns[j * count + k], ki = turns[k * count + i];
                const int signs[3] = {sign_of(ij), sign_of(jk), sign_of(ki)};
                const bool any_above = signs[0] > 0 || signs[1] > 0 || signs[2] > 0;
                const bool any_below = signs[0] < 0 || signs[1] < 0 || signs[2] < 0;
                if (any_above == any_below) continue;
                const Number volume = inner(product, points[k]), whole = ij + jk + ki;
                if (any_above) offer(volume, whole);
                else offer(-volume, -whole);
            }
        }
    return least;
}

}  // namespace espalier::oracle
