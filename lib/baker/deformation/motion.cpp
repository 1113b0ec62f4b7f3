#include <baker/deformation/motion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <baker/base/float_rounding.hpp>
#include <baker/base/number_text.hpp>
#include <baker/base/triangle_set.hpp>

namespace espalier::baker {

namespace {

constexpr float margin = 0.1f;  // of the largest side, where no range is given

void add(SourceBounds& bounds, const Vec3& point) {
    bounds.min = {std::min(bounds.min.x, point.x), std::min(bounds.min.y, point.y), std::min(bounds.min.z, point.z)};
    bounds.max = {std::max(bounds.max.x, point.x), std::max(bounds.max.y, point.y), std::max(bounds.max.z, point.z)};
}

void measure(SourceBounds& bounds) {
    bounds.largest_side =
        std::max({double(bounds.max.x) - double(bounds.min.x), double(bounds.max.y) - double(bounds.min.y),
                  double(bounds.max.z) - double(bounds.min.z)});
    bounds.largest_coordinate = std::max({std::abs(bounds.min.x), std::abs(bounds.min.y), std::abs(bounds.min.z),
                                          std::abs(bounds.max.x), std::abs(bounds.max.y), std::abs(bounds.max.z)});
}

/// Stays finite.
float moved(float coordinate, float by) {
    constexpr float most = std::numeric_limits<float>::max();
    return std::clamp(coordinate + by, -most, most);
}

Expected<Lattice> lattice_of(const SourceBounds& range, Resolution resolution) {
    switch (resolution.kind()) {
        case Resolution::Kind::bits:
            return lattice_for_bits(range, static_cast<unsigned>(resolution.value()));
        case Resolution::Kind::step:
            return lattice_for_step(range, static_cast<int>(resolution.value()));
        case Resolution::Kind::tolerance:
            break;
    }
    return lattice_for_tolerance(range, step_exponent_for_tolerance(resolution.value()), resolution.value());
}

/// Keeps the first of triangles over the same vertices in the same winding: they are equal in every pose.
void put_triangles(const Source& source, LatticeMesh& mesh, Findings& findings) {
    TriangleSet kept(source.triangles.size());
    for (const SourceTriangle& triangle : source.triangles) {
        const std::uint32_t next = kept.size();
        if (kept.find_or_insert(triangle.corners) == next) {
            mesh.triangles.push_back({triangle.corners, triangle.original_id});
        } else if (findings.duplicate.count++ == 0) {
            findings.duplicate = first_finding(source, triangle.original_id);
        }
    }
}

}  // namespace

SourceBounds range_of(const Source& source, const Deformation& deformation) {
    SourceBounds range;
    range.min = range.max = source.positions.front();
    for (const Vec3& point : source.positions) add(range, point);
    for (const std::vector<Vec3>& pose : deformation.poses)
        for (const Vec3& point : pose) add(range, point);
    if (deformation.range) {
        add(range, deformation.range->min);
        add(range, deformation.range->max);
    } else {
        measure(range);
        const float by = margin * static_cast<float>(std::min(range.largest_side, 0x1p127));
        range.min = {moved(range.min.x, -by), moved(range.min.y, -by), moved(range.min.z, -by)};
        range.max = {moved(range.max.x, by), moved(range.max.y, by), moved(range.max.z, by)};
    }
    measure(range);
    return range;
}

std::vector<LatticePoint> place(const std::vector<Vec3>& positions, const Lattice& lattice) {
    const double reciprocal_step = std::ldexp(1.0, -lattice.step_exponent);
    const Vec3& origin = lattice.origin;
    std::vector<LatticePoint> points;
    points.reserve(positions.size());
    for (const Vec3& point : positions)
        points.push_back({static_cast<std::int32_t>(snap_coordinate(point.x, origin.x, reciprocal_step)),
                          static_cast<std::int32_t>(snap_coordinate(point.y, origin.y, reciprocal_step)),
                          static_cast<std::int32_t>(snap_coordinate(point.z, origin.z, reciprocal_step))});
    return points;
}

Expected<FittedMesh> fit_range(const Source& source, const SourceBounds& range, Resolution resolution,
                               Findings& findings) {
    if (range.largest_side == 0.0)
        return Refusal{BakeStatus::invalid_options,
                       "the range of motion is a point: all positions are equal; give a range in which they move"};
    const auto lattice = lattice_of(range, resolution);
    if (!lattice) return lattice.refusal();
    // refit() computes in float: the origin in steps must be one.
    if (double(range.largest_coordinate) * std::ldexp(1.0, -lattice->step_exponent) >= 0x1p127)
        return Refusal{BakeStatus::too_fine, "the range of motion lies " +
                                                 number_text(double(range.largest_coordinate)) +
                                                 " from the origin, which is more than 2^127 steps of 2^" +
                                                 std::to_string(lattice->step_exponent) +
                                                 "; move the mesh to the origin, or choose a coarser step"};
    FittedMesh fitted;
    LatticeMesh& mesh = fitted.mesh;
    mesh.lattice = *lattice;
    mesh.is_deformable = true;
    mesh.vertices = place(source.positions, *lattice);
    mesh.is_used.assign(mesh.vertices.size(), 0);
    mesh.vertex_of_position.resize(mesh.vertices.size());
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertex_of_position[i] = i;
    put_triangles(source, mesh, findings);
    for (const LatticeTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.corners) {
            if (mesh.is_used[corner] == 0) ++mesh.used_vertices;
            mesh.is_used[corner] = 1;
        }
    mesh.extent = place({range.max}, *lattice).front();
    fitted.error.largest = largest_snap_error(lattice->step_exponent);
    return fitted;
}

}  // namespace espalier::baker
