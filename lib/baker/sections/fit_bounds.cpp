#include <baker/sections/fit_bounds.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <baker/sections/half_spaces.hpp>
#include <runtime/blob/stored_bounds.hpp>

namespace espalier::baker {

namespace {

using format::bounds::units_per_step;

/// A rotation that need not have length 1.
using Quaternion = std::array<double, 4>;

Quaternion multiply(const Quaternion& p, const Quaternion& q) {
    return {
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

/// The largest part becomes the largest that the format holds.
std::array<std::int32_t, 4> rounded(const Quaternion& q) {
    double largest = 0.0;
    for (const double part : q) largest = std::max(largest, std::abs(part));
    std::array<std::int32_t, 4> result{};
    for (std::size_t k = 0; k < 4; ++k)
        result[k] = static_cast<std::int32_t>(round_half_even(q[k] / largest * format::bounds::max_quaternion));
    return result;
}

std::int64_t along(const std::int32_t (&row)[3], const LatticePoint& point) {
    return std::int64_t{row[0]} * point.x + std::int64_t{row[1]} * point.y + std::int64_t{row[2]} * point.z;
}

struct Range {
    std::int64_t lo;
    std::int64_t hi;
};

Range range_along(const std::int32_t (&row)[3], std::span<const LatticePoint> points) {
    Range range{along(row, points[0]), along(row, points[0])};
    for (const LatticePoint& point : points) {
        const std::int64_t at = along(row, point);
        range.lo = std::min(range.lo, at);
        range.hi = std::max(range.hi, at);
    }
    return range;
}

detail::IntegerRotation rotation_of(const std::array<std::int32_t, 4>& q) {
    return detail::rotation_of(q[0], q[1], q[2], q[3]);
}

/// Half the surface of the box that holds the points in this rotation.
double half_area(const std::array<std::int32_t, 4>& quaternion, std::span<const LatticePoint> points) {
    const detail::IntegerRotation rotation = rotation_of(quaternion);
    double side[3];
    for (int k = 0; k < 3; ++k) {
        const Range range = range_along(rotation.row[k], points);
        side[k] = static_cast<double>(range.hi - range.lo) / rotation.norm;
    }
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

/// Divides by a positive number and rounds down.
std::int64_t divide_down(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

double squared_distance(const Point& a, const LatticePoint& b) {
    const double x = a.x - b.x;
    const double y = a.y - b.y;
    const double z = a.z - b.z;
    return x * x + y * y + z * z;
}

const LatticePoint& farthest_from(const Point& center, std::span<const LatticePoint> points) {
    const LatticePoint* farthest = &points[0];
    double distance = -1.0;
    for (const LatticePoint& point : points) {
        const double here = squared_distance(center, point);
        if (here <= distance) continue;
        distance = here;
        farthest = &point;
    }
    return *farthest;
}

}  // namespace

std::vector<LatticePoint> outermost_points(std::span<const LatticePoint> points) {
    constexpr std::int32_t fineness =
        4;  // directions to the grid points on the surface of a cube of 9^3, but not both ways
    std::vector<LatticePoint> found;
    for (std::int32_t x = 0; x <= fineness; ++x) {
        for (std::int32_t y = -fineness; y <= fineness; ++y) {
            for (std::int32_t z = -fineness; z <= fineness; ++z) {
                if (std::max({x, std::abs(y), std::abs(z)}) != fineness) continue;
                const std::int32_t direction[3] = {x, y, z};
                const LatticePoint* lowest = &points[0];
                const LatticePoint* highest = &points[0];
                std::int64_t low = along(direction, points[0]);
                std::int64_t high = low;
                for (const LatticePoint& point : points) {
                    const std::int64_t at = along(direction, point);
                    if (at < low) lowest = &point, low = at;
                    if (at > high) highest = &point, high = at;
                }
                for (const LatticePoint* end : {lowest, highest})
                    if (std::find(found.begin(), found.end(), *end) == found.end()) found.push_back(*end);
            }
        }
    }
    return found;
}

FittedBox fit_box(std::span<const LatticePoint> points, std::span<const LatticePoint> outermost) {
    constexpr double first_turn = 0.25;  // tangent of half an angle
    constexpr double last_turn = 0x1p-12;
    std::array<std::int32_t, 4> best = {format::bounds::max_quaternion, 0, 0, 0};
    double best_area = half_area(best, outermost);
    for (int start = 0; start < 27; ++start) {
        // A box looks the same after a quarter turn around an axis: these are all there is, give or take 20 degrees.
        const int x = start % 3, y = start / 3 % 3, z = start / 9;
        Quaternion at = {2.0, x - 1.0, y - 1.0, z - 1.0};
        double area = half_area(rounded(at), outermost);
        for (double turn = first_turn; turn >= last_turn;) {
            Quaternion next = at;
            double next_area = area;
            for (std::size_t axis = 1; axis < 4; ++axis) {
                for (const double sign : {1.0, -1.0}) {
                    Quaternion step = {1.0, 0.0, 0.0, 0.0};
                    step[axis] = sign * turn;
                    const Quaternion there = multiply(step, at);
                    const double there_area = half_area(rounded(there), outermost);
                    if (there_area >= next_area) continue;
                    next_area = there_area;
                    next = there;
                }
            }
            if (next_area < area) {
                at = next;
                area = next_area;
            } else {
                turn *= 0.5;
            }
        }
        if (area < best_area) {
            best_area = area;
            best = rounded(at);
        }
    }
    FittedBox box;
    box.quaternion = best;
    const detail::IntegerRotation rotation = rotation_of(best);
    for (std::size_t k = 0; k < 3; ++k) {
        // Below 2^4 * 2^24 * sqrt(3) * 2^24.
        const Range range = range_along(rotation.row[k], points);
        box.lo[k] = static_cast<std::int32_t>(divide_down(units_per_step * range.lo, rotation.norm));
        box.hi[k] = static_cast<std::int32_t>(-divide_down(-units_per_step * range.hi, rotation.norm));
    }
    return box;
}

FittedSphere fit_sphere(std::span<const LatticePoint> points, std::span<const LatticePoint> outermost) {
    constexpr int steps = 4096;
    constexpr int rounds = 8;  // a point of all that sticks out is one of the outermost from then on
    std::vector<LatticePoint> chosen(outermost.begin(), outermost.end());
    Point best{double(points[0].x), double(points[0].y), double(points[0].z)};
    double best_radius = -1.0;
    for (int round = 0; round < rounds; ++round) {
        Point center{double(chosen[0].x), double(chosen[0].y), double(chosen[0].z)};
        for (int i = 0; i < steps; ++i) {
            const LatticePoint& farthest = farthest_from(center, chosen);
            const double share = 1.0 / (i + 2.0);
            center.x += (farthest.x - center.x) * share;
            center.y += (farthest.y - center.y) * share;
            center.z += (farthest.z - center.z) * share;
        }
        const LatticePoint& farthest = farthest_from(center, points);
        const double radius = squared_distance(center, farthest);
        if (best_radius < 0.0 || radius < best_radius) {
            best_radius = radius;
            best = center;
        }
        if (std::find(chosen.begin(), chosen.end(), farthest) != chosen.end()) break;
        chosen.push_back(farthest);
    }
    FittedSphere sphere;
    const double center[3] = {best.x, best.y, best.z};
    for (std::size_t k = 0; k < 3; ++k)
        sphere.center[k] = static_cast<std::int32_t>(round_half_even(center[k] * units_per_step));
    std::int64_t squared = 0;  // below 3 * 2^56
    for (const LatticePoint& point : points) {
        const std::int64_t x = std::int64_t{units_per_step} * point.x - sphere.center[0];
        const std::int64_t y = std::int64_t{units_per_step} * point.y - sphere.center[1];
        const std::int64_t z = std::int64_t{units_per_step} * point.z - sphere.center[2];
        squared = std::max(squared, x * x + y * y + z * z);
    }
    auto radius = static_cast<std::int64_t>(std::sqrt(static_cast<double>(squared)));
    while (radius * radius < squared) ++radius;
    while (radius > 0 && (radius - 1) * (radius - 1) >= squared) --radius;
    sphere.radius = static_cast<std::uint32_t>(radius);
    return sphere;
}

FittedKDop fit_k_dop(std::span<const LatticePoint> points) {
    FittedKDop k_dop;
    for (std::size_t k = 0; k < format::bounds::k_dop_directions; ++k) {
        const auto& d = format::bounds::k_dop_direction[k];
        const std::int32_t direction[3] = {d[0], d[1], d[2]};
        const Range range = range_along(direction, points);
        k_dop.lo[k] = static_cast<std::int32_t>(range.lo);
        k_dop.hi[k] = static_cast<std::int32_t>(range.hi);
    }
    return k_dop;
}

}  // namespace espalier::baker
