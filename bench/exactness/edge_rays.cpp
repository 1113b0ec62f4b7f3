#include "edge_rays.hpp"

#include <baker/base/edge_table.hpp>
#include <baker/input/check_input.hpp>
#include <baker/quantise/snap.hpp>

#include "../../tests/oracle/double_geometry.hpp"

namespace espalier::bench {
namespace {

using reference::Point;
using reference::PointTriangle;

constexpr double least_cosine = 0.1;
/// The share of the ray's coordinates that its own rounding stays far below.
constexpr double ring_share = 0x1p-15;
constexpr double behind_share = 0x1p-12;
constexpr int direction_bits = 12;
constexpr double largest_exact = 0x1p24;
constexpr unsigned attempts = 200;  // for each ray

Point unit(Point a) { return (1.0 / length(a)) * a; }

/// Edges and triangles around each vertex.
class Surface {
public:
    explicit Surface(const SnappedMesh& snapped) : triangles_(snapped.mesh.triangles) {
        const double half_steps = 2.0 / snapped.step;
        for (const Vec3& p : snapped.mesh.positions)
            points_.push_back({double(p.x) * half_steps, double(p.y) * half_steps, double(p.z) * half_steps});
        for (const TriangleVertices& triangle : triangles_)
            for (const std::uint32_t v : triangle) {
                const Point& p = points_[v];
                largest_ = std::max({largest_, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
            }
        radius_ = double(bounding_sphere(snapped.mesh).radius) * half_steps;
        list_neighbours();
        list_triangles_of_vertices();
    }
    [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
    [[nodiscard]] const Point& corner(std::size_t triangle, std::size_t number) const {
        return points_[triangles_[triangle][number]];
    }
    [[nodiscard]] PointTriangle points_of(std::size_t triangle) const {
        return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
    }
    /// Returns the triangles at an edge of a triangle, none unless there are two that run along it in opposite ways.
    [[nodiscard]] std::vector<std::uint32_t> around_edge(std::uint32_t triangle, std::size_t number) const {
        const std::uint32_t other = neighbours_[triangle][number];
        return other == none ? std::vector<std::uint32_t>{} : std::vector<std::uint32_t>{triangle, other};
    }
    /// Returns the triangles at a corner, none unless every edge there has two triangles.
    [[nodiscard]] std::span<const std::uint32_t> around_corner(std::uint32_t triangle, std::size_t number) const {
        const std::uint32_t v = triangles_[triangle][number];
        const auto all = std::span(triangles_at_).subspan(ends_[v], ends_[v + 1] - ends_[v]);
        const bool is_closed = std::ranges::all_of(all, [&](std::uint32_t t) {
            for (std::size_t e = 0; e < 3; ++e)
                if ((triangles_[t][e] == v || triangles_[t][(e + 1) % 3] == v) && neighbours_[t][e] == none)
                    return false;
            return true;
        });
        return is_closed ? all : all.first(0);
    }
    [[nodiscard]] double largest_coordinate() const { return largest_; }
    [[nodiscard]] double radius() const { return radius_; }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    void list_neighbours() {
        neighbours_.assign(triangles_.size(), {none, none, none});
        const baker::EdgeTable table(static_cast<std::uint32_t>(triangles_.size()), points_.size(),
                                     [&](std::uint32_t t) -> const TriangleVertices& { return triangles_[t]; });
        table.for_each_pair([&](std::uint32_t, std::span<const baker::TriangleEdge> edges) {
            if (edges.size() != 2 || edges[0].ascends == edges[1].ascends) return;
            neighbours_[edges[0].triangle][edges[0].number] = edges[1].triangle;
            neighbours_[edges[1].triangle][edges[1].number] = edges[0].triangle;
        });
    }
    void list_triangles_of_vertices() {
        ends_.assign(points_.size() + 1, 0);
        for (const TriangleVertices& triangle : triangles_)
            for (const std::uint32_t v : triangle) ++ends_[v + 1];
        for (std::size_t v = 0; v < points_.size(); ++v) ends_[v + 1] += ends_[v];
        triangles_at_.resize(3 * triangles_.size());
        std::vector<std::size_t> next = ends_;
        for (std::uint32_t t = 0; t < triangles_.size(); ++t)
            for (const std::uint32_t v : triangles_[t]) triangles_at_[next[v]++] = t;
    }

    std::span<const TriangleVertices> triangles_;
    std::vector<Point> points_;  // in half steps: whole even numbers
    std::vector<std::array<std::uint32_t, 3>> neighbours_;
    std::vector<std::size_t> ends_;  // of each vertex, where its part of the next list begins
    std::vector<std::uint32_t> triangles_at_;
    double largest_ = 0.0;
    double radius_ = 0.0;
};

/// Where a ray is aimed at, in half steps, and the triangles there.
struct Place {
    Point point;
    std::vector<std::uint32_t> triangles;
};

class Aim {
public:
    Aim(const Surface& surface, double step, std::uint64_t number) : surface_(surface), step_(step), random_(number) {}

    [[nodiscard]] std::optional<EdgeRay> try_once(AimedAt aim) {
        const Place place = draw_place(aim);
        if (place.triangles.empty()) return std::nullopt;
        const Point direction = draw_direction(place);
        const double distance = surface_.radius() * (0.1 + 1.9 * double(random_.unit()));
        if (!is_sure(place, direction, distance)) return std::nullopt;
        return aim == AimedAt::edge_point ? rounded_ray(place, direction, distance)
                                          : exact_ray(place, direction, distance);
    }

private:
    Place draw_place(AimedAt aim) {
        const std::uint32_t triangle = random_.below(static_cast<std::uint32_t>(surface_.triangle_count()));
        const std::size_t number = random_.below(3);
        const Point &a = surface_.corner(triangle, number), &b = surface_.corner(triangle, (number + 1) % 3);
        if (aim == AimedAt::vertex) {
            const std::span<const std::uint32_t> around = surface_.around_corner(triangle, number);
            return {a, {around.begin(), around.end()}};
        }
        const double share = aim == AimedAt::edge_middle ? 0.5 : 0.1 + 0.8 * double(random_.unit());
        return {a + share * (b - a), surface_.around_edge(triangle, number)};
    }
    /// Against the mean of the normals, tilted by up to half a right angle; whole numbers of `direction_bits`.
    Point draw_direction(const Place& place) {
        Point mean;
        for (const std::uint32_t t : place.triangles) mean = mean + unit(normal_of(surface_.points_of(t)));
        const Vec3 tilt = random_.in_cube(0.5f);
        const Point way = Point{double(tilt.x), double(tilt.y), double(tilt.z)} - unit(mean);
        const double scale = (0x1p12 - 1.0) / std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
        return {std::nearbyint(scale * way.x), std::nearbyint(scale * way.y), std::nearbyint(scale * way.z)};
    }
    [[nodiscard]] bool is_sure(const Place& place, const Point& direction, double distance) const {
        const double least_ring = ring_share * (distance + surface_.largest_coordinate());
        const Point way = unit(direction);
        return std::ranges::all_of(place.triangles, [&](std::uint32_t t) {
            const PointTriangle points = surface_.points_of(t);
            if (!(dot(unit(normal_of(points)), way) <= -least_cosine)) return false;
            for (std::size_t e = 0; e < 3; ++e) {
                const double squared = squared_distance_to_segment(place.point, points[e], points[(e + 1) % 3]);
                // The edges on which the place lies are inside the ring.
                if (squared > 0x1p-20 && squared < least_ring * least_ring) return false;
            }
            return true;
        });
    }
    /// The place is whole in half steps, and so is the origin: a whole number of directions before it.
    [[nodiscard]] std::optional<EdgeRay> exact_ray(const Place& place, const Point& direction, double distance) const {
        const double times = std::ceil(distance / length(direction));
        const Point origin = place.point - times * direction;
        if (std::max({std::abs(origin.x), std::abs(origin.y), std::abs(origin.z)}) >= largest_exact)
            return std::nullopt;
        EdgeRay aimed;
        aimed.ray.origin = to_world(origin);
        const double unit_length = std::ldexp(1.0, -direction_bits);
        aimed.ray.direction = to_vector(unit_length * direction);
        aimed.farthest = static_cast<float>((1.0 + behind_share) * times * (0.5 * step_) / unit_length);
        return aimed;
    }
    [[nodiscard]] std::optional<EdgeRay> rounded_ray(const Place& place, const Point& direction,
                                                     double distance) const {
        EdgeRay aimed;
        aimed.ray.origin = to_world(place.point - distance * unit(direction));
        const Point from = {double(aimed.ray.origin.x), double(aimed.ray.origin.y), double(aimed.ray.origin.z)};
        const Point way = 0.5 * step_ * place.point - from;
        aimed.ray.direction = to_vector(unit(way));
        aimed.farthest = static_cast<float>((1.0 + behind_share) * length(way));
        return aimed;
    }
    [[nodiscard]] Vec3 to_world(const Point& p) const { return to_vector(0.5 * step_ * p); }
    static Vec3 to_vector(const Point& p) {
        return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }

    const Surface& surface_;
    double step_;
    tests::Random random_;
};

}  // namespace

SnappedMesh snap_mesh(const Mesh& mesh, unsigned bits) {
    const MeshView view = mesh.view();
    BakeOptions options;
    BakeReport report;
    const auto source = baker::check_input({&view, 1}, {}, options, report);
    if (!source) throw std::runtime_error(mesh.name + ": " + source.refusal().message);
    const auto lattice = baker::lattice_for_bits(baker::bounds_of(*source), bits);
    if (!lattice) throw std::runtime_error(mesh.name + ": " + lattice.refusal().message);
    const baker::LatticeMesh snapped = baker::snap_and_weld(*source, *lattice, report.findings);
    SnappedMesh result{{mesh.name, {}, {}, {}}, lattice->step()};
    const auto coordinate = [&](float origin, std::int32_t steps) {
        return static_cast<float>(double(origin) + steps * lattice->step());
    };
    const Vec3& origin = lattice->origin;
    for (const LatticePoint& p : snapped.vertices)
        result.mesh.positions.push_back(
            {coordinate(origin.x, p.x), coordinate(origin.y, p.y), coordinate(origin.z, p.z)});
    for (const baker::LatticeTriangle& t : snapped.triangles) result.mesh.triangles.push_back(t.corners);
    return result;
}

std::string_view name_of(AimedAt aim) {
    constexpr const char* names[] = {"vertex", "edge middle", "edge point"};
    return names[static_cast<std::size_t>(aim)];
}

std::vector<EdgeRay> edge_rays(const SnappedMesh& snapped, AimedAt aim, std::size_t count, std::uint64_t number) {
    std::vector<EdgeRay> rays;
    const Surface surface(snapped);
    if (surface.triangle_count() == 0 || 8.0 * surface.largest_coordinate() >= largest_exact) return rays;
    Aim aims(surface, snapped.step, number);
    for (std::size_t i = 0; i < attempts * count && rays.size() < count; ++i)
        if (const std::optional<EdgeRay> ray = aims.try_once(aim)) rays.push_back(*ray);
    return rays;
}

}  // namespace espalier::bench
