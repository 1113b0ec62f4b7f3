// How far triangles that were dropped are from what was kept.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <baker/base/edge_table.hpp>
#include <baker/error/kept_surface.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

class DroppedTriangles {
public:
    /// The mesh keeps at least one triangle. Both outlive this.
    DroppedTriangles(const Source& source, const LatticeMesh& mesh);

    /// An upper bound on the distance that any point of the triangle has from the kept surface, in world units; not a
    /// close one when it is no more than `ignore_below`. The triangle is one of LatticeMesh::collapsed or of
    /// Source::without_area.
    [[nodiscard]] double distance_of(const SourceTriangle& triangle, double ignore_below);

private:
    /// Corners as positions, the two that lie farthest apart first and last.
    using Line = std::array<std::uint32_t, 3>;

    [[nodiscard]] std::uint32_t vertex_of(std::uint32_t position) const { return vertex_of_position_[position]; }
    [[nodiscard]] StepPoint point_of(std::uint32_t position) const;
    [[nodiscard]] double snap_error_of(const Line& line) const;
    [[nodiscard]] Line line_of(const SourceTriangle& triangle) const;
    [[nodiscard]] bool is_covered(const Line& line) const;
    [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const;
    void find_vertices_of_those_without_area();
    void gather_edges();

    const Source& source_;
    const LatticeMesh& mesh_;
    double step_;
    double reciprocal_step_;
    std::vector<std::uint32_t> vertex_of_position_;  // LatticeMesh's, and more
    EdgeTable edges_;                                // of kept triangles
    std::optional<KeptSurface> surface_;             // built for the first triangle that needs it, which seldom comes
};

}  // namespace espalier::baker
