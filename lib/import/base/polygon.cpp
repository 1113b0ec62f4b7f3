#include <import/base/polygon.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace espalier::importer {

namespace {

void append_fan(std::uint32_t corners, std::vector<TriangleVertices>& triangles) {
    for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
}

}  // namespace

PolygonCut PolygonCutter::cut(std::span<const Vec3d> polygon, std::vector<TriangleVertices>& triangles) {
    const auto corners = static_cast<std::uint32_t>(polygon.size());
    const View view = corners == 3 ? View::not_finite : project(polygon);
    // Corners that are not finite are for the baker to refuse or to drop.
    if (view != View::projected) {
        append_fan(corners, triangles);
        return view == View::not_finite ? PolygonCut::simple : PolygonCut::crossing;
    }
    if (corners == 4) return cut_quad(triangles);
    if (!is_convex()) return ears_.cut(points_, triangles);
    append_fan(corners, triangles);
    return PolygonCut::simple;
}

PolygonCut PolygonCutter::cut_face(std::span<const std::uint32_t> corners, const std::vector<Vec3d>& positions,
                                   std::vector<TriangleVertices>& triangles) {
    polygon_.clear();
    for (const std::uint32_t vertex : corners) {
        polygon_.push_back(vertex < positions.size() ? positions[vertex]
                                                     : Vec3d{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    }
    const auto first = static_cast<std::ptrdiff_t>(triangles.size());
    const PolygonCut result = cut(polygon_, triangles);
    const auto added = std::span(triangles).subspan(static_cast<std::size_t>(first));
    for (TriangleVertices& triangle : added)
        for (std::uint32_t& index : triangle) index = corners[index];
    const auto repeats = [&](const auto& triangle) { return repeats_a_vertex(triangle, positions.size()); };
    if (corners.size() > 3)
        triangles.erase(std::remove_if(triangles.begin() + first, triangles.end(), repeats), triangles.end());
    return result;
}

/// Leaves out the axis along which the normal is longest.
PolygonCutter::View PolygonCutter::project(std::span<const Vec3d> polygon) {
    const auto from_first = [&polygon](std::size_t corner) {
        return std::array{polygon[corner].x - polygon[0].x, polygon[corner].y - polygon[0].y,
                          polygon[corner].z - polygon[0].z};
    };
    std::array<double, 3> normal{};
    bool has_area = false;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const auto a = from_first(i - 1);
        const auto b = from_first(i);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t u = (axis + 1) % 3;
            const std::size_t v = (axis + 2) % 3;
            const double part = a[u] * b[v] - a[v] * b[u];
            normal[axis] += part;
            has_area = has_area || part != 0.0;
        }
    }
    if (!std::isfinite(normal[0] + normal[1] + normal[2])) return View::not_finite;
    if (has_area && normal == std::array<double, 3>{}) return View::cancels_out;
    std::size_t axis = 0;
    for (const std::size_t other : {std::size_t{1}, std::size_t{2}}) {
        if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    }
    std::size_t u = (axis + 1) % 3;
    std::size_t v = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(u, v);
    points_.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto point = from_first(i);
        points_.push_back({point[u], point[v]});
    }
    return View::projected;
}

double PolygonCutter::area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return plane_area(points_[a], points_[b], points_[c]);
}

/// Every corner turns to the left, and together they turn once.
bool PolygonCutter::is_convex() const {
    const auto corners = static_cast<std::uint32_t>(points_.size());
    unsigned reversals = 0;
    double direction = 0.0;
    for (std::uint32_t i = 0; i < 2 * corners; ++i) {
        const std::uint32_t a = i % corners;
        const std::uint32_t b = (i + 1) % corners;
        if (area(a, b, (i + 2) % corners) <= 0.0) return false;
        const double step = points_[b][0] - points_[a][0];
        if (step == 0.0) continue;
        if (i >= corners && step * direction < 0.0) ++reversals;
        direction = step > 0.0 ? 1.0 : -1.0;
    }
    return reversals == 2;
}

PolygonCut PolygonCutter::cut_quad(std::vector<TriangleVertices>& triangles) const {
    const double first[] = {area(0, 1, 2), area(0, 2, 3)};
    const double second[] = {area(0, 1, 3), area(1, 2, 3)};
    const auto both_above = [](const double(&areas)[2]) { return areas[0] > 0.0 && areas[1] > 0.0; };
    const auto none_below = [](const double(&areas)[2]) { return areas[0] >= 0.0 && areas[1] >= 0.0; };
    const bool other = !both_above(first) && (both_above(second) || (!none_below(first) && none_below(second)));
    if (other) {
        triangles.push_back({0, 1, 3});
        triangles.push_back({1, 2, 3});
    } else {
        append_fan(4, triangles);
    }
    return other || none_below(first) ? PolygonCut::simple : PolygonCut::crossing;
}

}  // namespace espalier::importer
