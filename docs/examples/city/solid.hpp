// Meshes made of whole numbers: one unit is 1/64 m, which a float holds exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <espalier/bake.hpp>

namespace city {

inline constexpr int metre = 64;

struct Point {
    int x, y, z;
};

/// Returns a length in metres.
constexpr float in_metres(int units) { return static_cast<float>(units) / metre; }

/// A mesh under construction.
class Solid {
public:
    void add_triangle(const Point& a, const Point& b, const Point& c);
    /// Adds the quadrilateral a b c d, counter-clockwise when seen from the front.
    void add_quad(const Point& a, const Point& b, const Point& c, const Point& d);
    void add_box(const Point& low, const Point& high);
    /// Adds a gable roof over a rectangle, its ridge along y.
    void add_roof(const Point& low, const Point& high);
    /// Adds a body of eight sides around the z axis: rings of the given radii, a fixed height apart, with flat ends. A
    /// radius of 0 ends in a point.
    void add_rings(int bottom, int ring_height, const std::vector<int>& radii);

    [[nodiscard]] std::size_t triangle_count() const { return triangles_.size(); }
    [[nodiscard]] espalier::MeshView view() const { return {positions_, triangles_, {}, 0, 0, {}}; }

private:
    std::vector<espalier::Vec3> positions_;
    std::vector<espalier::TriangleVertices> triangles_;
};

}  // namespace city
