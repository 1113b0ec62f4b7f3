#include "point.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <import/base/placement.hpp>

#include "base/vectors.hpp"

namespace espalier::tools {

namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers with every compiler.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    double symmetric() { return 2.0 * unit() - 1.0; }

private:
    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
        return z ^ (z >> 31);
    }
    std::uint64_t state_;
};

using Point = std::array<double, 3>;

Vec3 vector_of(const Point& point) {
    return {static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2])};
}
Point between(const Point& from, const Point& to, double share) {
    Point result;
    for (std::size_t k = 0; k < 3; ++k) result[k] = from[k] + share * (to[k] - from[k]);
    return result;
}
double squared_length(const Point& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

/// A direction of length 1, all of them equally likely (by rejection, which needs no sine).
Point direction(Random& random) {
    while (true) {
        Point v = {random.symmetric(), random.symmetric(), random.symmetric()};
        const double squared = squared_length(v);
        if (squared > 1.0 || squared < 1e-3) continue;
        for (double& coordinate : v) coordinate /= std::sqrt(squared);
        return v;
    }
}

struct SurfaceTriangle {
    std::array<Point, 3> corners;
    double area_before;  ///< of all triangles before this one
};

struct SampledSurface {
    std::vector<SurfaceTriangle> triangles;
    double area = 0.0;
    PointBox box;

    void add(const std::array<Point, 3>& corners) {
        Point u, v;
        for (std::size_t k = 0; k < 3; ++k) {
            u[k] = corners[1][k] - corners[0][k];
            v[k] = corners[2][k] - corners[0][k];
        }
        const Point normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        const double own = 0.5 * std::sqrt(squared_length(normal));
        if (!(own > 0.0) || !std::isfinite(own)) return;
        triangles.push_back({corners, area});
        area += own;
        for (const auto& [x, y, z] : corners) box.add({x, y, z});
    }

    /// The point at this share of the whole area, at a random place of its triangle.
    [[nodiscard]] Point at(double share, Random& random) const {
        const auto is_before = [](double wanted, const SurfaceTriangle& t) { return wanted < t.area_before; };
        const auto after = std::upper_bound(triangles.begin(), triangles.end(), share * area, is_before);
        const SurfaceTriangle& triangle = *(after - 1);
        // Turpin (1990): a square root spreads points evenly over a triangle.
        const double across = std::sqrt(random.unit());
        const Point edge = between(triangle.corners[1], triangle.corners[2], random.unit());
        return between(triangle.corners[0], edge, across);
    }
};

SampledSurface surface_of(const ImportResult& source, const Vec3d& origin) {
    SampledSurface surface;
    for (const ImportedMesh& mesh : source.meshes) {
        for (const TriangleVertices& triangle : mesh.triangles) {
            std::array<Point, 3> corners;
            bool is_sound = true;
            for (std::size_t corner = 0; corner < 3 && is_sound; ++corner) {
                is_sound = triangle[corner] < mesh.positions.size();
                if (!is_sound) continue;
                const Vec3d position = mesh.positions[triangle[corner]] - origin;
                is_sound = is_finite(position);
                corners[corner] = {position.x, position.y, position.z};
            }
            if (is_sound) surface.add(corners);
        }
    }
    return surface;
}

}  // namespace

SampleQueries make_sample_queries(const ImportResult& source, const Vec3d& origin, std::size_t count) {
    SampleQueries queries;
    const SampledSurface surface = surface_of(source, origin);
    if (surface.triangles.empty()) return queries;
    Point center, sides;
    for (std::size_t k = 0; k < 3; ++k) {
        center[k] = 0.5 * (surface.box.low[k] + surface.box.high[k]);
        sides[k] = surface.box.high[k] - surface.box.low[k];
    }
    const double diagonal = std::sqrt(squared_length(sides));
    Random random(2026);
    for (std::size_t i = 0; i < count; ++i) {
        const Point outward = direction(random);
        Point from, heading;
        for (std::size_t k = 0; k < 3; ++k) {
            from[k] = center[k] + 0.6 * diagonal * outward[k];
            heading[k] = surface.box.low[k] + random.unit() * sides[k] - from[k];
        }
        const double length = std::sqrt(squared_length(heading));
        for (double& coordinate : heading) coordinate /= length;
        Ray ray;
        ray.origin = vector_of(from);
        ray.direction = vector_of(heading);
        queries.rays.push_back(ray);

        const Point on_surface = surface.at((static_cast<double>(i) + 0.5) / static_cast<double>(count), random);
        queries.surface_points.push_back(vector_of(on_surface));
        const Point aside = direction(random);
        const double by = random.unit() * diagonal / 20.0;
        Point middle;
        for (std::size_t k = 0; k < 3; ++k) middle[k] = on_surface[k] + by * aside[k];
        queries.spheres.push_back({vector_of(middle), static_cast<float>(diagonal / 40.0)});
    }
    return queries;
}

}  // namespace espalier::tools
