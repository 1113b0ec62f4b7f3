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
/// 3 axes, 6 diagonals of faces, 4 of the cube.
extern const std::array<Point, slab_count> slab_directions;

struct Slabs {
    std::array<double, slab_count> lo{};
    std::array<double, slab_count> hi{};
    std::vector<Point> corners;  ///< of the polytope
};

enum class Kind { sphere, aligned_box, oriented_box, k_dop };
inline constexpr std::array all_kinds = {Kind::sphere, Kind::aligned_box, Kind::oriented_box, Kind::k_dop};

struct Volumes {
    Ball ball;
    Block aligned;
    Block oriented;
    Slabs slabs;
    std::array<double, 4> areas{};  ///< of each kind
    std::array<double, 4> spaces{};

    [[nodiscard]] const Block& block(Kind kind) const { return kind == Kind::aligned_box ? aligned : oriented; }
};

[[nodiscard]] Volumes fit_volumes(std::span<const Point> points);

}  // namespace espalier::bench
