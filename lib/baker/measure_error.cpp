#include "measure_error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "float_rounding.hpp"
#include "kept_surface.hpp"

namespace espalier::baker {

namespace {

constexpr double rounding_margin = 1.0 + 0x1p-50;  // of the squares, their sum and the root

/// Coordinate minus lattice coordinate. The difference of coordinate and origin is taken as a sum without rounding error
/// (two-sum), the lattice part subtracted from it exactly.
double snap_error(float coordinate, float origin, double steps, double step) {
    const double a = double(coordinate);
    const double b = -double(origin);
    const double sum = a + b;
    const double virtual_part = sum - a;
    const double lost = (a - (sum - virtual_part)) + (b - virtual_part);
    return (sum - steps * step) + lost;
}

double distance(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z) * rounding_margin; }

/// How far a triangle's lattice image may be from itself, and the ends of that image, which is a point or a segment.
struct Image {
    StepPoint a;
    StepPoint b;
    double snap_error;
};

class DroppedTriangles {
public:
    DroppedTriangles(const Source& source, const LatticeMesh& mesh)
        : source_(source), mesh_(mesh), step_(mesh.lattice.step()), reciprocal_step_(1.0 / step_) {
        gather_edges();
    }

    /// The distance between vertex and source of a position that a triangle with an area uses.
    [[nodiscard]] double snap_error_of(std::uint32_t position) const {
        const Vec3& point = source_.positions[position];
        const LatticePoint& snapped = mesh_.vertices[mesh_.vertex_of_position[position]];
        const Vec3& origin = mesh_.lattice.origin;
        return distance(snap_error(point.x, origin.x, snapped.x, step_), snap_error(point.y, origin.y, snapped.y, step_),
                        snap_error(point.z, origin.z, snapped.z, step_));
    }

    /// The triangle's distance from the kept surface, or nothing when its snapped corners are vertices and edges of kept
    /// triangles: then it is no farther from them than its corners move.
    [[nodiscard]] std::optional<double> distance_of(const SourceTriangle& triangle, double ignore_below) {
        const auto corners = in_order_of_line(triangle);
        if (is_covered(corners)) return std::nullopt;
        if (!surface_) surface_.emplace(mesh_);
        const Image image = image_of(corners);
        const double ignored_steps = std::max(0.0, (ignore_below - image.snap_error) * reciprocal_step_);
        return surface_->farthest_of_segment(image.a, image.b, ignored_steps) * step_ + image.snap_error;
    }

private:
    static constexpr std::uint32_t none = InsertionTable::none;

    [[nodiscard]] std::uint32_t vertex_of(std::uint32_t position) const { return mesh_.vertex_of_position[position]; }

    /// In steps: the lattice point where there is one, else the position itself, which snapping has not moved.
    [[nodiscard]] StepPoint point_of(std::uint32_t position) const {
        if (const std::uint32_t vertex = vertex_of(position); vertex != none) {
            const LatticePoint& point = mesh_.vertices[vertex];
            return {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
        }
        const Vec3& point = source_.positions[position];
        const Vec3& origin = mesh_.lattice.origin;
        return {(double(point.x) - double(origin.x)) * reciprocal_step_, (double(point.y) - double(origin.y)) * reciprocal_step_,
                (double(point.z) - double(origin.z)) * reciprocal_step_};
    }

    /// Its corners, the two that lie farthest apart first and last.
    [[nodiscard]] std::array<std::uint32_t, 3> in_order_of_line(const SourceTriangle& triangle) const {
        const auto [a, b, c] = triangle.corners;
        const auto square = [&](std::uint32_t from, std::uint32_t to) {
            const StepPoint p = point_of(from);
            const StepPoint q = point_of(to);
            const double x = p[0] - q[0];
            const double y = p[1] - q[1];
            const double z = p[2] - q[2];
            return x * x + y * y + z * z;
        };
        const double ab = square(a, b);
        const double bc = square(b, c);
        const double ca = square(c, a);
        if (ca >= ab && ca >= bc) return {a, b, c};
        if (ab >= bc) return {a, c, b};
        return {b, a, c};
    }

    [[nodiscard]] Image image_of(const std::array<std::uint32_t, 3>& corners) const {
        Image image{point_of(corners[0]), point_of(corners[2]), 0.0};
        for (const std::uint32_t corner : corners) {
            if (vertex_of(corner) != none) image.snap_error = std::max(image.snap_error, snap_error_of(corner));
        }
        return image;
    }

    [[nodiscard]] bool is_covered(const std::array<std::uint32_t, 3>& corners) const {
        const std::uint32_t first = vertex_of(corners[0]);
        const std::uint32_t middle = vertex_of(corners[1]);
        const std::uint32_t last = vertex_of(corners[2]);
        if (first == none || middle == none || last == none) return false;
        return is_edge(first, last) || (is_edge(first, middle) && is_edge(middle, last));
    }

    /// Also true of a kept vertex alone.
    [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const {
        if (a == b) return mesh_.is_used[a] != 0;
        return std::binary_search(edges_.begin(), edges_.end(), edge_key(a, b));
    }
    static std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }

    /// The edges of kept triangles between vertices of dropped ones: the only ones that is_edge is asked for.
    void gather_edges() {
        std::vector<std::uint8_t> is_asked_for(mesh_.vertices.size(), 0);
        const auto mark = [&](const SourceTriangle& triangle) {
            for (const std::uint32_t corner : triangle.corners) {
                if (vertex_of(corner) != none) is_asked_for[vertex_of(corner)] = 1;
            }
        };
        std::for_each(mesh_.collapsed.begin(), mesh_.collapsed.end(), mark);
        std::for_each(source_.without_area.begin(), source_.without_area.end(), mark);
        for (const LatticeTriangle& triangle : mesh_.triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = triangle.corners[i];
                const std::uint32_t b = triangle.corners[(i + 1) % 3];
                if (is_asked_for[a] != 0 && is_asked_for[b] != 0) edges_.push_back(edge_key(a, b));
            }
        }
        std::sort(edges_.begin(), edges_.end());
    }

    const Source& source_;
    const LatticeMesh& mesh_;
    double step_;
    double reciprocal_step_;
    std::vector<std::uint64_t> edges_;
    std::optional<KeptSurface> surface_;  // built for the first triangle that needs it, which seldom comes
};

}  // namespace

MeasuredError measure_error(const Source& source, const LatticeMesh& mesh) {
    MeasuredError error;
    if (mesh.triangles.empty()) return error;
    const Vec3 origin = mesh.lattice.origin;
    const double step = mesh.lattice.step();
    double largest_square = 0.0;
    for (std::size_t i = 0; i < source.positions.size(); ++i) {
        if (mesh.vertex_of_position[i] == InsertionTable::none) continue;
        const Vec3& point = source.positions[i];
        const LatticePoint& snapped = mesh.vertices[mesh.vertex_of_position[i]];
        const double x = snap_error(point.x, origin.x, snapped.x, step);
        const double y = snap_error(point.y, origin.y, snapped.y, step);
        const double z = snap_error(point.z, origin.z, snapped.z, step);
        largest_square = std::max(largest_square, x * x + y * y + z * z);
    }
    double largest = std::sqrt(largest_square) * rounding_margin;
    if (!mesh.collapsed.empty() || !source.without_area.empty()) {
        DroppedTriangles dropped(source, mesh);
        const auto count_in = [&](const SourceTriangle& triangle) {
            const auto distance = dropped.distance_of(triangle, largest);
            if (!distance || *distance <= largest) return;
            largest = *distance;
            error.is_of_dropped = true;
            error.dropped_triangle = triangle.original_id;
        };
        std::for_each(mesh.collapsed.begin(), mesh.collapsed.end(), count_in);
        std::for_each(source.without_area.begin(), source.without_area.end(), count_in);
    }
    error.largest = round_up_to_float(largest);
    return error;
}

bool vertices_are_within(const Source& source, const Lattice& lattice, double tolerance) {
    const Vec3 origin = lattice.origin;
    const double step = lattice.step();
    const double reciprocal_step = 1.0 / step;
    const auto error_of = [&](float coordinate, float from) {
        return snap_error(coordinate, from, snap_coordinate(coordinate, from, reciprocal_step), step);
    };
    for (const SourceTriangle& triangle : source.triangles) {
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3& point = source.positions[corner];
            const double moved =
                distance(error_of(point.x, origin.x), error_of(point.y, origin.y), error_of(point.z, origin.z));
            if (moved > tolerance) return false;
        }
    }
    return true;
}

}  // namespace espalier::baker
