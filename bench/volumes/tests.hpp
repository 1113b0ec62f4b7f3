// The tests of triangles that a walk makes in leaves, in double.
#pragma once

#include <array>
#include <optional>

#include "shapes.hpp"

namespace espalier::bench {

struct Line {
    Point origin;
    Point direction;
};

/// x -> rotation x + shift; the rotation's rows.
struct Pose {
    std::array<Point, 3> rotation;
    Point shift;

    [[nodiscard]] Point turned(const Point& p) const {
        return {dot(rotation[0], p), dot(rotation[1], p), dot(rotation[2], p)};
    }
    [[nodiscard]] Point operator()(const Point& p) const { return turned(p) + shift; }
};

using Corners3 = std::array<Point, 3>;
[[nodiscard]] std::optional<double> meets(const Corners3& triangle, const Line& line);
[[nodiscard]] bool touches(const Corners3& triangle, const Ball& ball);
[[nodiscard]] bool touch(const Corners3& a, const Corners3& b);

}  // namespace espalier::bench
