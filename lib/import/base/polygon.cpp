#include <import/base/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::importer {

namespace {

void append_fan(std::uint32_t corners, std::vector<TriangleVertices>& triangles) {
    for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
}

}  // namespace

bool PolygonCutter::cut(std::span<const Vec3d> polygon, std::vector<TriangleVertices>& triangles) {
    const auto corners = static_cast<std::uint32_t>(polygon.size());
    const View view = corners == 3 ? View::not_finite : project(polygon);
    // Corners that are not finite are for the baker to refuse or to drop.
    if (view != View::projected) {
        append_fan(corners, triangles);
        return view == View::not_finite;
    }
    if (corners == 4) return cut_quad(triangles);
    if (!is_convex()) return cut_ears(triangles);
    append_fan(corners, triangles);
    return true;
}

bool PolygonCutter::cut_face(std::span<const std::uint32_t> corners, const std::vector<Vec3d>& positions,
                             std::vector<TriangleVertices>& triangles) {
    polygon_.clear();
    for (const std::uint32_t vertex : corners) {
        polygon_.push_back(vertex < positions.size() ? positions[vertex]
                                                     : Vec3d{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
    }
    const auto first = static_cast<std::ptrdiff_t>(triangles.size());
    const bool is_simple = cut(polygon_, triangles);
    const auto added = std::span(triangles).subspan(static_cast<std::size_t>(first));
    for (TriangleVertices& triangle : added)
        for (std::uint32_t& index : triangle) index = corners[index];
    const auto repeats = [&](const auto& triangle) { return repeats_a_vertex(triangle, positions.size()); };
    if (corners.size() > 3)
        triangles.erase(std::remove_if(triangles.begin() + first, triangles.end(), repeats), triangles.end());
    return is_simple;
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

/// Twice the area; positive if the corners run counter-clockwise.
double PolygonCutter::area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    const Point& first = points_[a];
    const Point& second = points_[b];
    const Point& third = points_[c];
    return (second[0] - first[0]) * (third[1] - first[1]) - (second[1] - first[1]) * (third[0] - first[0]);
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

bool PolygonCutter::cut_quad(std::vector<TriangleVertices>& triangles) const {
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
    return other || none_below(first);
}

/// The triangle at the corner has an area and contains no other corner.
bool PolygonCutter::is_ear(std::uint32_t corner) const {
    if (turns_[corner] <= 0.0) return false;
    const std::uint32_t a = before_[corner];
    const std::uint32_t c = after_[corner];
    for (std::uint32_t other = after_[c]; other != a; other = after_[other]) {
        // If any corner is inside then one is that does not turn to the left.
        if (turns_[other] > 0.0) continue;
        const Point& point = points_[other];
        if (point == points_[a] || point == points_[corner] || point == points_[c]) continue;
        if (area(a, corner, other) >= 0.0 && area(corner, c, other) >= 0.0 && area(c, a, other) >= 0.0) return false;
    }
    return true;
}

void PolygonCutter::update(std::uint32_t corner) { turns_[corner] = area(before_[corner], corner, after_[corner]); }

bool PolygonCutter::cut_ears(std::vector<TriangleVertices>& triangles) {
    const auto corners = static_cast<std::uint32_t>(points_.size());
    before_.resize(corners);
    after_.resize(corners);
    turns_.resize(corners);
    ears_.resize(corners);
    for (std::uint32_t i = 0; i < corners; ++i) {
        before_[i] = i == 0 ? corners - 1 : i - 1;
        after_[i] = i + 1 == corners ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < corners; ++i) update(i);
    for (std::uint32_t i = 0; i < corners; ++i) ears_[i] = is_ear(i) ? 1 : 0;

    std::uint32_t corner = 0;
    std::uint32_t left = corners;
    const auto cut_off = [&](std::uint32_t tip) {
        const std::uint32_t a = before_[tip];
        const std::uint32_t c = after_[tip];
        triangles.push_back({a, tip, c});
        after_[a] = c;
        before_[c] = a;
        --left;
        update(a);
        update(c);
        ears_[a] = is_ear(a) ? 1 : 0;
        ears_[c] = is_ear(c) ? 1 : 0;
        corner = c;
    };
    // Returns false if a round of the corners left has none for which `take` returns true.
    const auto find = [&](const auto& take) {
        for (std::uint32_t i = 0; i < left; ++i, corner = after_[corner]) {
            if (take(corner)) return true;
        }
        return false;
    };
    while (left > 3) {
        if (find([&](std::uint32_t i) { return ears_[i] != 0; }) || find([&](std::uint32_t i) { return is_ear(i); }) ||
            find([&](std::uint32_t i) { return turns_[i] == 0.0; })) {
            cut_off(corner);
            continue;
        }
        // Only a polygon that crosses itself has none.
        for (std::uint32_t i = after_[corner]; after_[i] != corner; i = after_[i]) {
            triangles.push_back({corner, i, after_[i]});
        }
        return false;
    }
    triangles.push_back({before_[corner], corner, after_[corner]});
    return turns_[corner] >= 0.0;
}

}  // namespace espalier::importer
