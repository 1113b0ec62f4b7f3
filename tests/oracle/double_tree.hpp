// The reference: a plain binary tree over triangles in double precision, for rays and closest points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "double_geometry.hpp"

namespace espalier::reference {

/// Ray, as asked in floats, which double holds exactly.
struct PointRay {
    Point origin;
    Point direction;
};

struct ReferenceHit {
    bool is_hit = false;
    double t = 0.0;
    std::uint32_t triangle = 0;
    /// Whether rounding in double could have changed which side of a triangle's edge the ray passes.
    bool is_doubtful = false;
};

struct ReferenceNearest {
    double squared_distance = 0.0;
    std::uint32_t triangle = 0;
};

class DoubleTree {
public:
    explicit DoubleTree(std::vector<PointTriangle> triangles);

    [[nodiscard]] const std::vector<PointTriangle>& triangles() const { return triangles_; }
    /// Both sides, t from 0 on.
    [[nodiscard]] ReferenceHit closest_hit(const PointRay& ray) const;
    /// There must be a triangle. `guess` is a triangle that may be near: a good one saves time.
    [[nodiscard]] ReferenceNearest nearest(Point point, std::uint32_t guess = 0) const;

private:
    struct Box {
        Point low, high;
    };
    /// Inner nodes have no triangles; their children are the next node and `second`.
    struct Node {
        Box box;
        std::uint32_t first = 0, count = 0, second = 0;
    };

    [[nodiscard]] Box box_of(std::uint32_t triangle) const;
    void build(std::size_t first, std::size_t count);

    std::vector<PointTriangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace espalier::reference
