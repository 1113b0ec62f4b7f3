// How much space the bounds take.
#include <cmath>
#include <vector>

#include "fit_bounds.hpp"

namespace espalier::baker {

namespace {

using format::bounds::units_per_step;

struct Point {
    double x, y, z;
};
Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(const Point& a, const Point& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// All points with dot(normal, point) <= offset.
struct HalfSpace {
    Point normal;
    double offset;
};

/// The part of a polygon that is in the half-space (Sutherland, Hodgman 1974).
std::vector<Point> clipped(const std::vector<Point>& polygon, const HalfSpace& half_space) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point& here = polygon[i];
        const Point& next = polygon[(i + 1) % polygon.size()];
        const double above = dot(half_space.normal, here) - half_space.offset;
        const double next_above = dot(half_space.normal, next) - half_space.offset;
        if (above <= 0.0) kept.push_back(here);
        if ((above < 0.0 && next_above > 0.0) || (above > 0.0 && next_above < 0.0))
            kept.push_back(here + (above / (above - next_above)) * (next - here));
    }
    return kept;
}

/// The face of the polyhedron that lies on half-space `number`, out of a square that is larger than all of it.
std::vector<Point> face(const std::vector<HalfSpace>& all, std::size_t number, double size) {
    const HalfSpace& own = all[number];
    const Point middle = (own.offset / dot(own.normal, own.normal)) * own.normal;
    const Point u = cross(own.normal, {1.0, 0.5, 0.25});  // along which no half-space faces
    const Point v = cross(own.normal, u);
    const Point a = (size / std::sqrt(dot(u, u))) * u;
    const Point b = (size / std::sqrt(dot(v, v))) * v;
    std::vector<Point> polygon = {middle + a, middle + b, middle - a, middle - b};
    for (std::size_t i = 0; i < all.size() && !polygon.empty(); ++i)
        if (i != number) polygon = clipped(polygon, all[i]);
    return polygon;
}

}  // namespace

double volume_of(const FittedBox& box) {
    double volume = 1.0;
    for (std::size_t k = 0; k < 3; ++k) volume *= double(box.hi[k] - box.lo[k]) / units_per_step;
    return volume;
}

double volume_of(const FittedSphere& sphere) {
    const double radius = double(sphere.radius) / units_per_step;
    return 4.0 / 3.0 * 3.14159265358979323846 * radius * radius * radius;
}

double volume_of(const FittedKDop& k_dop, const LatticePoint& extent) {
    std::vector<HalfSpace> all;
    const auto add = [&](const Point& normal, double lo, double hi) {
        all.push_back({normal, hi});
        all.push_back({-1.0 * normal, -lo});
    };
    add({1.0, 0.0, 0.0}, 0.0, extent.x);
    add({0.0, 1.0, 0.0}, 0.0, extent.y);
    add({0.0, 0.0, 1.0}, 0.0, extent.z);
    for (std::size_t k = 0; k < format::bounds::k_dop_directions; ++k) {
        const auto& d = format::bounds::k_dop_direction[k];
        add({double(d[0]), double(d[1]), double(d[2])}, k_dop.lo[k], k_dop.hi[k]);
    }
    const double size = 8.0 * (double(extent.x) + extent.y + extent.z);
    double volume = 0.0;  // of the pyramids from the origin to each face
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::vector<Point> polygon = face(all, i, size);
        for (std::size_t k = 2; k < polygon.size(); ++k)
            volume +=
                std::abs(dot(polygon[0], cross(polygon[k - 1], polygon[k]))) / 6.0 * (all[i].offset < 0.0 ? -1.0 : 1.0);
    }
    return volume;
}

}  // namespace espalier::baker
