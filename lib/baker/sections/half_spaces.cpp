#include <baker/sections/half_spaces.hpp>

#include <cmath>
#include <cstddef>

namespace espalier::baker {

namespace {

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

}  // namespace

std::vector<std::vector<Point>> faces_of(std::span<const HalfSpace> half_spaces, double size) {
    std::vector<std::vector<Point>> faces;
    for (const HalfSpace& own : half_spaces) {
        // A square on the plane, larger than all of the body.
        const Point middle = (own.offset / dot(own.normal, own.normal)) * own.normal;
        const Point u = cross(own.normal, {1.0, 0.5, 0.25});
        const Point v = cross(own.normal, u);
        const Point a = (4.0 * size / std::sqrt(dot(u, u))) * u;
        const Point b = (4.0 * size / std::sqrt(dot(v, v))) * v;
        std::vector<Point> polygon = {middle + a, middle + b, middle - a, middle - b};
        for (const HalfSpace& other : half_spaces)
            if (&other != &own && !polygon.empty()) polygon = clipped(polygon, other);
        faces.push_back(polygon.size() < 3 ? std::vector<Point>() : std::move(polygon));
    }
    return faces;
}

}  // namespace espalier::baker
