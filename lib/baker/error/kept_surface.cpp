#include <baker/error/kept_surface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <baker/build/sah.hpp>

namespace espalier::baker {

namespace {

// Limits of the work, far beyond what meshes need that are not made to reach them. At a limit the bound found so far
// has to do.
constexpr unsigned most_pieces = 2048;                 // of one segment
constexpr std::uint64_t most_distances = 200'000'000;  // to triangles, in all: some ten seconds
constexpr unsigned most_distances_then = 64;           // for one point, when those are used up
constexpr double good_enough = 1.01;
constexpr double negligible = 0.001;  // of a step

StepPoint operator-(const StepPoint& a, const StepPoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const StepPoint& a, const StepPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const StepPoint& a) { return std::sqrt(dot(a, a)); }
StepPoint cross(const StepPoint& a, const StepPoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

StepPoint to_steps(const LatticePoint& point) {
    return {static_cast<double>(point.x), static_cast<double>(point.y), static_cast<double>(point.z)};
}

double distance_to_segment(const StepPoint& point, const StepPoint& a, const StepPoint& b) {
    const StepPoint along = b - a;
    const double share = std::clamp(dot(point - a, along) / dot(along, along), 0.0, 1.0);
    return length(
        {point[0] - a[0] - share * along[0], point[1] - a[1] - share * along[1], point[2] - a[2] - share * along[2]});
}

double square_distance_to_box(const StepPoint& point, const BinaryNode& node) {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double below = double(node.lo[axis]) - point[axis];
        const double above = point[axis] - double(node.hi[axis]);
        const double outside = std::max({below, above, 0.0});
        sum += outside * outside;
    }
    return sum;
}

}  // namespace

KeptSurface::KeptSurface(const LatticeMesh& mesh)
    : mesh_(mesh), tree_(build_sah(mesh, build_settings(Effort::fast, 1))), distances_left_(most_distances) {}

double KeptSurface::distance_to_triangle(const StepPoint& point, std::uint32_t triangle) const {
    const auto& corners = mesh_.triangles[triangle].corners;
    const StepPoint a = to_steps(mesh_.vertices[corners[0]]);
    const StepPoint b = to_steps(mesh_.vertices[corners[1]]);
    const StepPoint c = to_steps(mesh_.vertices[corners[2]]);
    const StepPoint normal = cross(b - a, c - a);
    const bool is_above = dot(cross(normal, b - a), point - a) >= 0.0 && dot(cross(normal, c - b), point - b) >= 0.0 &&
                          dot(cross(normal, a - c), point - c) >= 0.0;
    if (is_above) return std::abs(dot(normal, point - a)) / length(normal);
    return std::min(
        {distance_to_segment(point, a, b), distance_to_segment(point, b, c), distance_to_segment(point, c, a)});
}

KeptSurface::Nearest KeptSurface::nearest(const StepPoint& point, double enough) {
    struct Waiting {
        std::uint32_t node;
        double square_distance;
    };
    std::array<Waiting, max_binary_height + 1> stack;
    std::size_t waiting = 0;
    std::uint64_t distances_left = std::max<std::uint64_t>(distances_left_, most_distances_then);
    stack[waiting++] = {0, square_distance_to_box(point, tree_.nodes[0])};
    Nearest best{std::numeric_limits<double>::infinity(), tree_.triangles[0]};
    while (waiting != 0) {
        const Waiting next = stack[--waiting];
        if (next.square_distance >= best.distance * best.distance) continue;
        const BinaryNode& node = tree_.nodes[next.node];
        if (node.is_leaf()) {
            const std::uint32_t triangle = tree_.triangles[node.first];
            const double distance = distance_to_triangle(point, triangle);
            if (distance < best.distance) best = {distance, triangle};
            distances_left_ -= distances_left_ == 0 ? 0 : 1;
            if (distance <= enough || --distances_left == 0) break;
            continue;
        }
        Waiting near{static_cast<std::uint32_t>(BinaryTree::left_of(next.node)), 0.0};
        Waiting far{static_cast<std::uint32_t>(tree_.right_of(next.node)), 0.0};
        near.square_distance = square_distance_to_box(point, tree_.nodes[near.node]);
        far.square_distance = square_distance_to_box(point, tree_.nodes[far.node]);
        if (far.square_distance < near.square_distance) std::swap(near, far);
        stack[waiting++] = far;
        stack[waiting++] = near;
    }
    return best;
}

/// Three upper bounds, of which the least counts: the distance to one triangle is convex, so along the segment it is
/// largest at an end, be it of the triangle near a or of the one near b; and no distance grows faster than one walks.
/// Where the least is too much, both halves are looked at.
double KeptSurface::bound(const StepPoint& a, const Nearest& near_a, const StepPoint& b, const Nearest& near_b,
                          double ignore_below, unsigned& pieces) {
    const double least = std::max(near_a.distance, near_b.distance);
    const double by_walking = (near_a.distance + near_b.distance + length(b - a)) / 2;
    const double to_triangle_a = std::max(near_a.distance, distance_to_triangle(b, near_a.triangle));
    const double to_triangle_b = std::max(near_b.distance, distance_to_triangle(a, near_b.triangle));
    const double most = std::min({by_walking, to_triangle_a, to_triangle_b});
    if (most <= std::max(ignore_below, least * good_enough) || pieces >= most_pieces) return most;
    ++pieces;
    const StepPoint middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
    const Nearest near_middle = nearest(middle, ignore_below);
    return std::max(bound(a, near_a, middle, near_middle, ignore_below, pieces),
                    bound(middle, near_middle, b, near_b, ignore_below, pieces));
}

double KeptSurface::farthest_of_segment(const StepPoint& a, const StepPoint& b, double ignore_below) {
    const double enough = std::max(ignore_below, negligible);
    unsigned pieces = 1;
    const double computed = bound(a, nearest(a, enough), b, nearest(b, enough), enough, pieces);
    // Lattice coordinates, edges and normals are exact in binary64; what is rounded is some 2^-50 of the largest
    // coordinate.
    const double largest_coordinate = std::max({length(a), length(b), std::ldexp(1.0, format::max_bits)});
    return computed + largest_coordinate * 0x1p-44;
}

}  // namespace espalier::baker
