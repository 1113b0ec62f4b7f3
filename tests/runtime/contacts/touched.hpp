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

inline Point middle_of(const Points& points) {
    Point sum;
    for (const Point& p : points) sum = sum + p;
    return (1.0 / static_cast<double>(points.size())) * sum;
}

/// A convex body beside a triangle.
struct Beside {
    Points body;  ///< of the shape without its radius
    Points triangle;
    Point middle;  ///< of the body
    double error;  ///< what is allowed
    bool has_edge_flags = false;
    double middle_error = 0.0;  ///< by how much the library's middle is off

    /// The unit normal of the triangle toward the middle; zero without area.
    [[nodiscard]] Point outward() const {
        const Point normal = reference::normal_of({triangle[0], triangle[1], triangle[2]});
        const double size = reference::length(normal);
        return size > 0.0 ? ((reference::dot(normal, middle - triangle[0]) < 0.0 ? -1.0 : 1.0) / size) * normal
                          : normal;
    }
    /// Whether a way out leads the middle through the triangle, by more than `slack`.
    [[nodiscard]] bool leads_through(const Point& way, double slack) const {
        double ahead = -std::numeric_limits<double>::infinity();
        for (const Point& p : triangle) ahead = std::max(ahead, reference::dot(way, p - middle));
        return ahead > slack;
    }
    /// Whether this may be the distance: the separation, unless the shortest way out leads the middle through the
    /// triangle. Then the body leaves along `outward`.
    [[nodiscard]] bool is_distance(double distance, double separation) const {
        const Point normal = outward();
        if (std::abs(distance - separation) <= error && separation >= -error) return true;
        // Of a body that hardly touches only rounding decides.
        if (separation >= -error)
            return separation <= error && distance < 0.0 &&
                   distance >= reference::gap_along(normal, body, triangle) - error;
        bool may_be_shortest = false, may_lead_through = false;
        reference::for_each_way_out(body, triangle, [&](Point way, double gap) {
            if (gap < separation - error) return;
            may_be_shortest = may_be_shortest || !leads_through(way, error + middle_error);
            may_lead_through = may_lead_through || has_edge_flags || leads_through(way, -error - middle_error);
        });
        if (reference::length(normal) == 0.0) may_be_shortest = true;
        if (may_be_shortest && std::abs(distance - separation) <= error) return true;
        if (!may_lead_through) return false;
        const bool is_level = std::abs(reference::dot(normal, middle - triangle[0])) <= error + middle_error;
        return std::abs(distance + reference::depth_along(normal, body, triangle)) <= error ||
               (is_level && std::abs(distance + reference::depth_along(-1.0 * normal, body, triangle)) <= error);
    }
};

/// What a case needs for its verdict.
struct Case : Beside {
    double size;  ///< how far both reach from the middle
};

/// Tests the first place against the reference and the others by their own definition.
inline void require_right(const Case& asked, const detail::contacts::Touches& touches, double& worst) {
    const double expected = reference::signed_separation(asked.body, asked.triangle);
    const detail::contacts::Touch& first = touches.touch[0];
    const double distance = static_cast<double>(first.distance), nearest = static_cast<double>(touches.nearest);
    worst = std::max(worst, std::abs(nearest - expected) / asked.size);
    REQUIRE(std::abs(nearest - expected) <= asked.error);
    REQUIRE(asked.is_distance(distance, expected));
    const double off = expected > 0.0 ? asked.size * asked.error / std::max(expected, asked.error) : 0.0;
    for (unsigned i = 0; i < touches.count; ++i) {
        const detail::contacts::Touch& touch = touches.touch[i];
        const Point normal = to_point(touch.normal), place = to_point(touch.point);
        REQUIRE(std::abs(reference::length(normal) - 1.0) < 1e-6);
        const reference::PointTriangle triangle = {asked.triangle[0], asked.triangle[1], asked.triangle[2]};
        REQUIRE(std::sqrt(reference::squared_distance(place, triangle)) <= asked.error);
        if (reference::length(asked.outward()) > 0.0)
            REQUIRE(reference::dot(normal, asked.middle - place) >= -4.0 * asked.error - asked.middle_error - off);
        // No place is deeper than the least way out along this normal, of a body that does more than touch.
        if (std::abs(expected) > asked.error) REQUIRE(static_cast<double>(touch.distance) >= distance - asked.error);
        if (i == 0 && distance <= 0.0) continue;
        CAPTURE(i);
        // The body begins there: the point at that distance along the normal belongs to it.
        const Point on_body = place + static_cast<double>(touch.distance) * normal;
        REQUIRE(reference::signed_separation({on_body}, asked.body) <= (i == 0 ? 1.0 : 4.0) * asked.error);
    }
    // The direction separates by the depth. That of closest points does by the distance, but where two pairs are
    // equally far but for rounding it may be that of either.
    const double gap = reference::gap_along(to_point(first.normal), asked.body, asked.triangle);
    if (expected > 0.0 && expected < asked.size * 1e-3) return;  // only rounding tells the direction
    const double turned = asked.size * (asked.error / std::max(expected, 1.0) + 0x1p-10);
    REQUIRE(gap - expected <= (expected > 0.0 ? turned : asked.error));
    const bool may_be_led_back =
        expected <= asked.error && reference::dot(to_point(first.normal), asked.outward()) > 0.999999;
    if (!may_be_led_back) REQUIRE(expected - gap <= (expected > 0.0 ? turned : asked.error));
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

/// A point near the triangle, or a corner of it, or on it, or on a side that is longer: beyond the tip of a needle.
inline GridPoint point_near(Random& random, unsigned bits, const GridTriangle& t) {
    const GridPoint corners[3] = {t.a, t.b, t.c};
    const GridPoint p = some_grid_point(random, bits), q = corners[random.below(3)], r = corners[random.below(3)];
    GridPoint result;
    const unsigned kind = random.below(5);
    const std::int32_t parts = random.between(1, 64);
    for (unsigned k = 0; k < 3; ++k)
        result[k] = kind == 0   ? p[k]
                    : kind == 1 ? (q[k] + r[k]) / 2
                    : kind == 2 ? (q[k] * 3 + p[k]) / 4
                    : kind == 3 ? q[k]
                                : q[k] + static_cast<std::int32_t>(std::int64_t{q[k] - r[k]} * parts / 256);
    return result;
}

/// A box with whole half axes, in units of 2^-fraction_bits steps.
inline detail::contacts::BoxBody box_of(const detail::Integer3& center, std::span<const Vec3, 3> half_axes,
                                        int fraction_bits) {
    using namespace detail::contacts;
    using detail::operator*;
    BoxBody box{};
    box.center = center;
    box.fraction_bits = fraction_bits;
    for (unsigned k = 0; k < 3; ++k) {
        const Vec3& h = half_axes[k];
        box.units[k] = {static_cast<std::int64_t>(h.x), static_cast<std::int64_t>(h.y), static_cast<std::int64_t>(h.z)};
        box.half[k] = h * std::ldexp(1.0f, -fraction_bits);
        box.size += std::abs(box.half[k].x) + std::abs(box.half[k].y) + std::abs(box.half[k].z);
    }
    for (unsigned k = 0; k < 3; ++k)
        box.face[k] = direction_of(detail::wide_cross(box.units[(k + 1) % 3], box.units[(k + 2) % 3]));
    return box;
}

/// The side of a triangle on which a point of the grid lies.
inline detail::contacts::FacingSide side_of(const GridPoint& at, const GridTriangle& triangle) {
    const Points corners = corners_of(triangle);
    const Point normal = reference::normal_of({corners[0], corners[1], corners[2]});
    return {reference::dot(normal, to_point(at) - corners[0]) < 0.0, {}, {}, {}};
}

}  // namespace espalier::tests
