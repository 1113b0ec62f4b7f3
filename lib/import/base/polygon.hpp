// Polygons with any number of corners to triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/bake.hpp>

namespace espalier::importer {

/// Tests whether all corners are below `vertices` and two are the same one: such a triangle of a polygon or of a strip
/// has no surface, and readers leave it out.
inline bool repeats_a_vertex(const TriangleVertices& triangle, std::size_t vertices) {
    const auto [a, b, c] = triangle;
    return a < vertices && b < vertices && c < vertices && (a == b || b == c || c == a);
}

/// Cuts polygons; keeps its memory from one to the next.
class PolygonCutter {
public:
    /// Appends corners - 2 triangles, which name corners of the polygon and run the same way round as it. Together they
    /// cover a polygon that does not cross itself, concave or not, seen along its normal; a triangle without area
    /// appears only where corners coincide or where no other cut exists. Returns false, after a fan of triangles around
    /// one corner, where the polygon crosses itself. A polygon has at least 3 corners.
    bool cut(std::span<const Vec3d> polygon, std::vector<TriangleVertices>& triangles);
    /// Appends the triangles of a face whose corners are numbers of positions; a number beyond them stays, for the
    /// baker to refuse or to drop. Leaves out triangles of a polygon that repeat a vertex. Returns false as cut() does.
    bool cut_face(std::span<const std::uint32_t> corners, const std::vector<Vec3d>& positions,
                  std::vector<TriangleVertices>& triangles);

private:
    using Point = std::array<double, 2>;

    /// How a polygon looks along its normal. `cancels_out`: it has none, though parts of it have an area.
    enum class View : std::uint8_t { projected, not_finite, cancels_out };

    View project(std::span<const Vec3d> polygon);
    [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] bool is_convex() const;
    bool cut_quad(std::vector<TriangleVertices>& triangles) const;
    bool cut_ears(std::vector<TriangleVertices>& triangles);
    [[nodiscard]] bool is_ear(std::uint32_t corner) const;
    void update(std::uint32_t corner);

    std::vector<Point> points_;  // the polygon seen along its normal, counter-clockwise
    std::vector<std::uint32_t> before_;
    std::vector<std::uint32_t> after_;
    std::vector<double> turns_;
    std::vector<char> ears_;
    std::vector<Vec3d> polygon_;  // of a face
};

}  // namespace espalier::importer
