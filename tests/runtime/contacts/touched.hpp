// What a contact of a convex body with a triangle has to be, by a reference in double that tries every plane through
// three differences of vertices.
#pragma once

#include "support/testing.hpp"

#include <runtime/contacts/touch.hpp>

#include "oracle/minkowski.hpp"
#include "oracle/surfaces.hpp"
#include "support/exact/grid_triangles.hpp"

namespace espalier::tests {

using reference::Point;
using reference::to_point;
using Points = std::vector<Point>;

inline Points corners_of(const GridTriangle& t) { return {to_point(t.a), to_point(t.b), to_point(t.c)}; }

/// The corners of a box that may be turned or sheared.
inline Points corners_of(const Point& center, std::span<const Vec3, 3> half_axes) {
    Points corners;
    for (unsigned corner = 0; corner < 8; ++corner) {
        Point p = center;
        for (unsigned k = 0; k < 3; ++k) p = p + ((corner >> k & 1u) != 0 ? 1.0 : -1.0) * to_point(half_axes[k]);
        corners.push_back(p);
    }
    return corners;
}

/// What a case needs for its verdict.
struct Case {
    Points body;  ///< of the shape without its radius
    Points triangle;
    double size;   ///< how far both reach from the middle
    double error;  ///< what is allowed
};

/// Tests the first place against the reference and the others by their own definition.
inline void require_right(const Case& asked, const detail::contacts::Touches& touches, double& worst) {
    const double expected = reference::signed_separation(asked.body, asked.triangle);
    const detail::contacts::Touch& first = touches.touch[0];
    const double distance = static_cast<double>(first.distance);
    worst = std::max(worst, std::abs(distance - expected) / asked.size);
    REQUIRE(std::abs(distance - expected) <= asked.error);
    for (unsigned i = 0; i < touches.count; ++i) {
        const detail::contacts::Touch& touch = touches.touch[i];
        const Point normal = to_point(touch.normal), place = to_point(touch.point);
        REQUIRE(std::abs(reference::length(normal) - 1.0) < 1e-6);
        const reference::PointTriangle triangle = {asked.triangle[0], asked.triangle[1], asked.triangle[2]};
        REQUIRE(std::sqrt(reference::squared_distance(place, triangle)) <= asked.error);
        // No place is deeper than the least way out along this normal.
        REQUIRE(static_cast<double>(touch.distance) >= distance - asked.error);
        if (i == 0 && distance <= 0.0) continue;
        // The body begins there: the point at that distance along the normal belongs to it.
        const Point on_body = place + static_cast<double>(touch.distance) * normal;
        REQUIRE(reference::signed_separation({on_body}, asked.body) <= (i == 0 ? 1.0 : 4.0) * asked.error);
    }
    // The direction separates by the depth. That of closest points does by the distance, but where two pairs are
    // equally far but for rounding it may be that of either.
    const double gap = reference::gap_along(to_point(first.normal), asked.body, asked.triangle);
    if (expected > 0.0 && expected < asked.size * 1e-3) return;  // only rounding tells the direction
    const double turned = asked.size * (asked.error / std::max(expected, 1.0) + 0x1p-10);
    REQUIRE(std::abs(gap - expected) <= (expected > 0.0 ? turned : asked.error));
}

/// What came of many bodies with volume beside a triangle.
struct Tally {
    double worst = 0.0;
    std::uint64_t near = 0, deep = 0, several = 0;

    /// Tests the places of a body, or that it is beyond the margin where there are none.
    void take(const Case& asked, const detail::contacts::Touches& touches, float margin) {
        if (touches.count == 0) {
            const double separation = reference::signed_separation(asked.body, asked.triangle);
            REQUIRE(separation >= static_cast<double>(margin) - asked.error);
            return;
        }
        ++near;
        require_right(asked, touches, worst);
        if (touches.touch[0].distance < 0.0f) ++deep;
        if (touches.count > 1) ++several;
    }
    void report(std::uint64_t count, const char* name) const {
        CHECK(near > count / 4);
        CHECK(deep > count / 20);
        CHECK(several > count / 20);
        MESSAGE(count, " ", name, ", ", near, " near, ", deep, " deep, ", several, " in several places; worst error ",
                worst, " of the size");
    }
};

/// A point near the triangle, or a corner of it, or on it.
inline GridPoint point_near(Random& random, unsigned bits, const GridTriangle& t) {
    const GridPoint corners[3] = {t.a, t.b, t.c};
    const GridPoint p = some_grid_point(random, bits), q = corners[random.below(3)], r = corners[random.below(3)];
    GridPoint result;
    const unsigned kind = random.below(4);
    for (unsigned k = 0; k < 3; ++k)
        result[k] = kind == 0 ? p[k] : kind == 1 ? (q[k] + r[k]) / 2 : kind == 2 ? (q[k] * 3 + p[k]) / 4 : q[k];
    return result;
}

}  // namespace espalier::tests
