#include <baker/error/measure_error.hpp>

#include <algorithm>
#include <cmath>

#include <baker/base/float_rounding.hpp>
#include <baker/error/dropped_triangles.hpp>
#include <baker/error/snap_error.hpp>

namespace espalier::baker {

MeasuredError measure_error(const Source& source, const LatticeMesh& mesh) {
    MeasuredError error;
    if (mesh.triangles.empty()) return error;
    const Vec3 origin = mesh.lattice.origin;
    const double step = mesh.lattice.step();
    double largest_square = 0.0;
    for (std::size_t i = 0; i < source.positions.size(); ++i) {
        const std::uint32_t vertex = mesh.vertex_of_position[i];
        if (vertex == IndexedHashSet::none) continue;
        const double square = square_snap_error(source.positions[i], origin, mesh.vertices[vertex], step);
        largest_square = std::max(largest_square, square);
    }
    double largest = std::sqrt(largest_square) * rounding_margin;
    if (!mesh.collapsed.empty() || !source.without_area.empty()) {
        DroppedTriangles dropped(source, mesh);
        const auto count_in = [&](const SourceTriangle& triangle) {
            const double distance = dropped.distance_of(triangle, largest);
            if (distance <= largest) return;
            largest = distance;
            error.is_of_dropped = true;
            error.dropped_triangle = triangle.original_id;
        };
        std::for_each(mesh.collapsed.begin(), mesh.collapsed.end(), count_in);
        std::for_each(source.without_area.begin(), source.without_area.end(), count_in);
    }
    error.largest = round_up_to_float(largest + source.moved);
    return error;
}

bool vertices_are_within(const Source& source, int step_exponent, double tolerance) {
    const double step = std::ldexp(1.0, step_exponent);
    const double reciprocal_step = 1.0 / step;
    const double square_tolerance = tolerance * tolerance;
    const auto error_of = [&](double coordinate) {
        return coordinate - snap_to_step(coordinate, reciprocal_step) * step;
    };
    for (const SourceTriangle& triangle : source.triangles) {
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3d& point = source.positions[corner];
            const double x = error_of(point.x);
            const double y = error_of(point.y);
            const double z = error_of(point.z);
            if (x * x + y * y + z * z > square_tolerance) return false;
        }
    }
    return true;
}

}  // namespace espalier::baker
