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

/// Stays finite. Positions that refit() takes are float32.
double moved(double coordinate, float by) {
    constexpr float most = std::numeric_limits<float>::max();
    return double(std::clamp(static_cast<float>(coordinate) + by, -most, most));
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
    SourceBounds range(source.positions.front());
    for (const Vec3d& point : source.positions) range.add(point);
    for (const std::vector<Vec3>& pose : deformation.poses)
        for (const Vec3& point : pose) range.add(to_float64(point));
    if (deformation.range) {
        range.add(to_float64(deformation.range->min));
        range.add(to_float64(deformation.range->max));
    } else {
        range.measure();
        const float by = margin * static_cast<float>(std::min(range.largest_side, 0x1p127));
        range.min = {moved(range.min.x, -by), moved(range.min.y, -by), moved(range.min.z, -by)};
        range.max = {moved(range.max.x, by), moved(range.max.y, by), moved(range.max.z, by)};
    }
    range.measure();
    return range;
}

LatticePoint place(const Vec3d& position, const Lattice& lattice) {
    const double reciprocal_step = std::ldexp(1.0, -lattice.step_exponent);
    const Vec3& origin = lattice.origin;
    return {static_cast<std::int32_t>(snap_coordinate(position.x, origin.x, reciprocal_step)),
            static_cast<std::int32_t>(snap_coordinate(position.y, origin.y, reciprocal_step)),
            static_cast<std::int32_t>(snap_coordinate(position.z, origin.z, reciprocal_step))};
}

Expected<FittedMesh> fit_range(const Source& source, const SourceBounds& range, Resolution resolution,
                               Findings& findings) {
    if (range.largest_side == 0.0)
        return Refusal{BakeStatus::invalid_options,
                       "the range of motion is a point: all positions are equal; give a range in which they move"};
    const auto lattice = lattice_of(range, resolution);
    if (!lattice) return lattice.refusal();
    // refit() computes in float: the origin in steps must be one.
    if (range.largest_coordinate * std::ldexp(1.0, -lattice->step_exponent) >= 0x1p127)
        return Refusal{BakeStatus::too_fine, "the range of motion lies " + number_text(range.largest_coordinate) +
                                                 " from the origin, which is more than 2^127 steps of 2^" +
                                                 std::to_string(lattice->step_exponent) +
                                                 "; move the mesh to the origin, or choose a coarser step"};
    FittedMesh fitted;
    LatticeMesh& mesh = fitted.mesh;
    mesh.lattice = *lattice;
    mesh.is_deformable = true;
    for (const Vec3d& position : source.positions) mesh.vertices.push_back(place(position, *lattice));
    mesh.is_used.assign(mesh.vertices.size(), 0);
    mesh.vertex_of_position.resize(mesh.vertices.size());
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertex_of_position[i] = i;
    put_triangles(source, mesh, findings);
    for (const LatticeTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.corners) {
            if (mesh.is_used[corner] == 0) ++mesh.used_vertices;
            mesh.is_used[corner] = 1;
        }
    mesh.extent = place(range.max, *lattice);
    fitted.error.largest = round_up_to_float(double(largest_snap_error(lattice->step_exponent)) + source.moved);
    return fitted;
}

}  // namespace espalier::baker
