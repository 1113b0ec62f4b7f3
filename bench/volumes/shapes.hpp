// The bounding volumes that are compared: each fitted to the same points.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <baker/sections/half_spaces.hpp>

namespace espalier::bench {

using baker::cross;
using baker::dot;
using baker::Point;

struct Ball {
    Point center{};
    double radius = 0.0;
};

/// Perpendicular axes of length 1.
struct Block {
    Point center{};
    std::array<Point, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::array<double, 3> half{};
};

inline constexpr std::size_t slab_count = 13;
/// The normals of all slabs, not of length 1: 3 axes, 6 diagonals of a cube's faces, 4 of the cube.
extern const std::array<Point, slab_count> slab_directions;

struct Slabs {
    std::array<double, slab_count> lo{};
    std::array<double, slab_count> hi{};
};

/// A discrete orientation polytope (k-DOP) is what lies in all of its k / 2 slabs.
enum class Kind { sphere, aabb, obb, dop_14, dop_18, dop_26 };
inline constexpr std::array all_kinds = {Kind::sphere, Kind::aabb, Kind::obb, Kind::dop_14, Kind::dop_18, Kind::dop_26};

/// The slabs of a k-DOP: the axes and the diagonals of the cube (14), or of its faces (18), or both (26).
template <std::size_t k>
constexpr std::array<std::size_t, k / 2> dop_slabs() {
    static_assert(k == 14 || k == 18 || k == 26);
    std::array<std::size_t, k / 2> slabs{};
    for (std::size_t i = 0; i < k / 2; ++i) slabs[i] = k == 14 && i >= 3 ? i + 6 : i;
    return slabs;
}

struct Volumes {
    Ball ball;
    Block aligned;
    Block oriented;
    Slabs slabs;
};

/// Fits a volume of each kind to the same points.
[[nodiscard]] Volumes fit_volumes(std::span<const Point> points);

struct Extent {
    double area = 0.0;
    double volume = 0.0;
};
/// Returns the surface area and the volume of a kind.
[[nodiscard]] Extent extent_of(Kind kind, const Volumes& volumes);

}  // namespace espalier::bench
