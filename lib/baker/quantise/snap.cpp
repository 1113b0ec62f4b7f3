#include <baker/quantise/snap.hpp>

#include <algorithm>

#include <baker/base/indexed_hash_set.hpp>
#include <baker/base/triangle_set.hpp>

namespace espalier::baker {

namespace {

/// The lattice points of all positions that a triangle with an area uses, numbered without repetition.
class VertexWelder {
public:
    VertexWelder(const Source& source, const Lattice& lattice, LatticeMesh& mesh)
        : source_(source),
          origin_(lattice.origin),
          reciprocal_step_(std::ldexp(1.0, -lattice.step_exponent)),
          vertices_(mesh.vertices),
          welded_(mesh.vertex_of_position),
          table_(source.positions.size()) {
        welded_.assign(source.positions.size(), IndexedHashSet::none);
    }

    std::uint32_t weld(std::uint32_t position) {
        std::uint32_t& vertex = welded_[position];
        // mutant(== -> true) work: welds a position again for each of its triangles, to the same vertex
        if (vertex == IndexedHashSet::none) {
            const LatticePoint point = snap(source_.positions[position]);
            vertex = table_.find_or_insert(hash_of(point), static_cast<std::uint32_t>(vertices_.size()),
                                           [&](std::uint32_t other) { return vertices_[other] == point; });
            if (vertex == vertices_.size()) vertices_.push_back(point);
        }
        return vertex;
    }

private:
    [[nodiscard]] LatticePoint snap(const Vec3d& point) const {
        return {static_cast<std::int32_t>(snap_coordinate(point.x, origin_.x, reciprocal_step_)),
                static_cast<std::int32_t>(snap_coordinate(point.y, origin_.y, reciprocal_step_)),
                static_cast<std::int32_t>(snap_coordinate(point.z, origin_.z, reciprocal_step_))};
    }

    const Source& source_;
    Vec3 origin_;
    double reciprocal_step_;
    std::vector<LatticePoint>& vertices_;
    std::vector<std::uint32_t>& welded_;
    IndexedHashSet table_;
};

/// Keeps the first of equal triangles.
void drop_duplicates(const Source& source, std::vector<LatticeTriangle>& triangles, Findings& findings) {
    constexpr std::size_t lookahead = 16;  // enough lookups in flight to hide the memory's latency
    TriangleSet kept(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (i + lookahead < triangles.size()) kept.prefetch(triangles[i + lookahead].corners);
        const std::uint32_t next = kept.size();
        if (kept.find_or_insert(triangles[i].corners) == next) {
            triangles[next] = triangles[i];
        } else if (findings.duplicate.count++ == 0) {
            findings.duplicate = first_finding(source, triangles[i].original_id);
        }
    }
    triangles.resize(kept.size());
}

/// Marks the vertices of kept triangles and moves the lattice so that their smallest coordinates are 0.
///
/// They are 0 already unless a collapsed triangle reached farthest. The origin then becomes the place of another
/// vertex, which float32 represents, and no vertex moves.
void settle(LatticeMesh& mesh) {
    mesh.is_used.assign(mesh.vertices.size(), 0);
    if (mesh.triangles.empty()) return;
    for (const LatticeTriangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle.corners) mesh.is_used[corner] = 1;
    }
    LatticePoint low = mesh.vertices[mesh.triangles.front().corners[0]];
    LatticePoint high = low;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (mesh.is_used[i] == 0) continue;
        const LatticePoint& point = mesh.vertices[i];
        low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
        ++mesh.used_vertices;
    }
    mesh.extent = {high.x - low.x, high.y - low.y, high.z - low.z};
    const double step = mesh.lattice.step();
    Vec3& origin = mesh.lattice.origin;
    origin = {static_cast<float>(double(origin.x) + low.x * step), static_cast<float>(double(origin.y) + low.y * step),
              static_cast<float>(double(origin.z) + low.z * step)};
    for (LatticePoint& point : mesh.vertices) point = {point.x - low.x, point.y - low.y, point.z - low.z};
}

}  // namespace

LatticeMesh snap_and_weld(const Source& source, const Lattice& lattice, Findings& findings) {
    LatticeMesh mesh;
    mesh.lattice = lattice;
    mesh.triangles.reserve(source.triangles.size());
    findings.collapsed = {};
    findings.duplicate = {};
    {
        VertexWelder welder(source, lattice, mesh);
        for (const SourceTriangle& triangle : source.triangles) {
            const auto a = welder.weld(triangle.corners[0]);
            const auto b = welder.weld(triangle.corners[1]);
            const auto c = welder.weld(triangle.corners[2]);
            if (is_collapsed(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c])) {
                mesh.collapsed.push_back(triangle);
            } else {
                mesh.triangles.push_back({{a, b, c}, triangle.original_id});
            }
        }
    }
    if (!mesh.collapsed.empty()) {
        findings.collapsed = first_finding(source, mesh.collapsed.front().original_id);
        findings.collapsed.count = mesh.collapsed.size();
    }
    drop_duplicates(source, mesh.triangles, findings);
    settle(mesh);
    return mesh;
}

}  // namespace espalier::baker
