// The tests that a walk makes: of volumes, which may say yes where nothing is, and of triangles.
#pragma once

#include <array>
#include <optional>

#include "shapes.hpp"

namespace espalier::bench {

struct Line {
    Point origin;
    Point direction;
};

/// Where the line, from its origin on, enters the volume.
[[nodiscard]] std::optional<double> entry(Kind kind, const Volumes& volumes, const Line& line);
[[nodiscard]] bool touches(Kind kind, const Volumes& volumes, const Ball& ball);

/// x -> rotation x + shift; the rotation's rows.
struct Pose {
    std::array<Point, 3> rotation;
    Point shift;

    [[nodiscard]] Point turned(const Point& p) const {
        return {dot(rotation[0], p), dot(rotation[1], p), dot(rotation[2], p)};
    }
    [[nodiscard]] Point operator()(const Point& p) const { return turned(p) + shift; }
};

/// Of a as it is and b in the pose. Spheres by their centers, boxes of both kinds by all 15 axes (Gottschalk et al.
/// 1996), k-DOPs by the 13 directions of each.
[[nodiscard]] bool touch(Kind kind, const Volumes& a, const Volumes& b, const Pose& pose);

using Corners3 = std::array<Point, 3>;
[[nodiscard]] std::optional<double> meets(const Corners3& triangle, const Line& line);
[[nodiscard]] bool touches(const Corners3& triangle, const Ball& ball);
[[nodiscard]] bool touch(const Corners3& a, const Corners3& b);

}  // namespace espalier::bench
