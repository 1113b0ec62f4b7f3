// Polygons with any number of corners to triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <espalier/bake.hpp>

#include <import/base/ear_cutter.hpp>

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
    /// appears only where corners coincide or where no other cut exists. Where the polygon crosses itself, a fan of
    /// triangles around one corner ends them. A polygon has at least 3 corners.
    PolygonCut cut(std::span<const Vec3d> polygon, std::vector<TriangleVertices>& triangles);
    /// Appends the triangles of a face whose corners are numbers of positions; a number beyond them stays, for the
    /// baker to refuse or to drop. Leaves out triangles of a polygon that repeat a vertex.
    PolygonCut cut_face(std::span<const std::uint32_t> corners, const std::vector<Vec3d>& positions,
                        std::vector<TriangleVertices>& triangles);

private:
    /// How a polygon looks along its normal. `cancels_out`: it has none, though parts of it have an area.
    enum class View : std::uint8_t { projected, not_finite, cancels_out };

    View project(std::span<const Vec3d> polygon);
    [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] bool is_convex() const;
    PolygonCut cut_quad(std::vector<TriangleVertices>& triangles) const;

    std::vector<PlanePoint> points_;  // the polygon seen along its normal, counter-clockwise
    EarCutter ears_;
    std::vector<Vec3d> polygon_;  // of a face
};

}  // namespace espalier::importer
