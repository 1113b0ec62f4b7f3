#include <baker/error/dropped_triangles.hpp>

#include <algorithm>
#include <cmath>

#include <baker/error/snap_error.hpp>

namespace espalier::baker {

namespace {

constexpr std::uint32_t none = IndexedHashSet::none;

double square_distance(const StepPoint& a, const StepPoint& b) {
    const double x = a[0] - b[0];
    const double y = a[1] - b[1];
    const double z = a[2] - b[2];
    return x * x + y * y + z * z;
}

}  // namespace

DroppedTriangles::DroppedTriangles(const Source& source, const LatticeMesh& mesh)
    : source_(source),
      mesh_(mesh),
      step_(mesh.lattice.step()),
      reciprocal_step_(1.0 / step_),
      vertex_of_position_(mesh.vertex_of_position) {
    find_vertices_of_those_without_area();
    gather_edges();
}

/// On the lattice the triangle is a point or a segment, from which it is no farther than its corners moved. Mostly that
/// is a vertex or an edge of a kept triangle.
double DroppedTriangles::distance_of(const SourceTriangle& triangle, double ignore_below) {
    const Line line = line_of(triangle);
    const double moved = snap_error_of(line);
    if (is_covered(line)) return moved;
    if (!surface_) surface_.emplace(mesh_);
    const double ignored_steps = std::max(0.0, (ignore_below - moved) * reciprocal_step_);
    return surface_->farthest_of_segment(point_of(line[0]), point_of(line[2]), ignored_steps) * step_ + moved;
}

/// In steps: the lattice point where there is one, else the position itself, which snapping has not moved.
StepPoint DroppedTriangles::point_of(std::uint32_t position) const {
    if (const std::uint32_t vertex = vertex_of(position); vertex != none) {
        const LatticePoint& point = mesh_.vertices[vertex];
        return {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
    }
    const Vec3d& point = source_.positions[position];
    const Vec3& origin = mesh_.lattice.origin;
    return {(point.x - double(origin.x)) * reciprocal_step_, (point.y - double(origin.y)) * reciprocal_step_,
            (point.z - double(origin.z)) * reciprocal_step_};
}

double DroppedTriangles::snap_error_of(const Line& line) const {
    double largest = 0.0;
    for (const std::uint32_t position : line) {
        if (vertex_of(position) == none) continue;
        const LatticePoint& snapped = mesh_.vertices[vertex_of(position)];
        largest =
            std::max(largest, square_snap_error(source_.positions[position], mesh_.lattice.origin, snapped, step_));
    }
    return std::sqrt(largest) * rounding_margin;
}

DroppedTriangles::Line DroppedTriangles::line_of(const SourceTriangle& triangle) const {
    const auto [a, b, c] = triangle.corners;
    const double ab = square_distance(point_of(a), point_of(b));
    const double bc = square_distance(point_of(b), point_of(c));
    const double ca = square_distance(point_of(c), point_of(a));
    if (ca >= ab && ca >= bc) return {a, b, c};
    if (ab >= bc) return {a, c, b};
    return {b, a, c};
}

bool DroppedTriangles::is_covered(const Line& line) const {
    const std::uint32_t first = vertex_of(line[0]);
    const std::uint32_t middle = vertex_of(line[1]);
    const std::uint32_t last = vertex_of(line[2]);
    if (first == none || middle == none || last == none) return false;
    return is_edge(first, last) || (is_edge(first, middle) && is_edge(middle, last));
}

/// Also true of a kept vertex alone.
bool DroppedTriangles::is_edge(std::uint32_t a, std::uint32_t b) const {
    if (a == b) return mesh_.is_used[a] != 0;
    return edges_.contains(a, b);
}

/// Positions that only triangles without area have may still snap to a vertex, as they do where triangles share no
/// indices.
void DroppedTriangles::find_vertices_of_those_without_area() {
    if (source_.without_area.empty()) return;
    IndexedHashSet table(mesh_.vertices.size());
    for (std::uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
        table.find_or_insert(hash_of(mesh_.vertices[i]), i, [&](std::uint32_t) { return false; });
    }
    for (const SourceTriangle& triangle : source_.without_area) {
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3d& position = source_.positions[corner];
            const Vec3& origin = mesh_.lattice.origin;
            const StepPoint steps = {snap_coordinate(position.x, origin.x, reciprocal_step_),
                                     snap_coordinate(position.y, origin.y, reciprocal_step_),
                                     snap_coordinate(position.z, origin.z, reciprocal_step_)};
            const auto is_on_lattice = [](double step) { return step >= 0.0 && step < 0x1p24; };
            if (vertex_of(corner) != none || !std::all_of(steps.begin(), steps.end(), is_on_lattice)) continue;
            const LatticePoint point = {static_cast<std::int32_t>(steps[0]), static_cast<std::int32_t>(steps[1]),
                                        static_cast<std::int32_t>(steps[2])};
            vertex_of_position_[corner] =
                table.find(hash_of(point), [&](std::uint32_t other) { return mesh_.vertices[other] == point; });
        }
    }
}

/// Gathers the edges of kept triangles with two vertices of dropped ones: is_edge is called for no others.
void DroppedTriangles::gather_edges() {
    std::vector<std::uint8_t> is_of_dropped(mesh_.vertices.size(), 0);
    const auto mark = [&](const SourceTriangle& triangle) {
        for (const std::uint32_t corner : triangle.corners) {
            if (vertex_of(corner) != none) is_of_dropped[vertex_of(corner)] = 1;
        }
    };
    std::for_each(mesh_.collapsed.begin(), mesh_.collapsed.end(), mark);
    std::for_each(source_.without_area.begin(), source_.without_area.end(), mark);
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
        const auto [a, b, c] = mesh_.triangles[i].corners;
        if (is_of_dropped[a] + is_of_dropped[b] + is_of_dropped[c] >= 2) near.push_back(i);
    }
    const auto corners_of = [&](std::uint32_t i) -> const std::array<std::uint32_t, 3>& {
        return mesh_.triangles[near[i]].corners;
    };
    edges_ = EdgeTable(static_cast<std::uint32_t>(near.size()), mesh_.vertices.size(), corners_of);
}

}  // namespace espalier::baker
