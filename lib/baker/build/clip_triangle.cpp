#include <baker/build/clip_triangle.hpp>

#include <array>

namespace espalier::baker {

namespace {

using Coordinates = std::array<std::int64_t, 3>;

Coordinates coordinates_of(const LatticePoint& point) { return {point.x, point.y, point.z}; }

Lanes lanes_of(const Coordinates& point) {
    return Lanes{static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]), 0.0f};
}

/// Returns the integer at or below numerator / denominator; denominator > 0.
std::int64_t floor_of(std::int64_t numerator, std::int64_t denominator) {
    const std::int64_t quotient = numerator / denominator;
    return numerator % denominator < 0 ? quotient - 1 : quotient;
}

/// Adds the point where the side crosses the plane, rounded outward; low[axis] < plane < high[axis].
void add_crossing(LaneBox& box, const Coordinates& low, const Coordinates& high, unsigned axis, std::int64_t plane) {
    Coordinates down;
    Coordinates up;
    const std::int64_t length = high[axis] - low[axis];
    for (std::size_t k = 0; k < 3; ++k) {
        // Below 2^24 times 2^24.
        const std::int64_t product = (high[k] - low[k]) * (plane - low[axis]);
        down[k] = low[k] + floor_of(product, length);
        up[k] = low[k] - floor_of(-product, length);
    }
    box.add(lanes_of(down), lanes_of(up));
}

LaneBox intersection(const LaneBox& a, const LaneBox& b) {
    LaneBox both;
    both.lo = larger(a.lo, b.lo);
    both.hi = smaller(a.hi, b.hi);
    return both;
}

}  // namespace

ClippedParts clip(const LatticeMesh& mesh, const Reference& reference, unsigned axis, float plane) {
    const auto& corners = mesh.triangles[reference.triangle].corners;
    const auto at = static_cast<std::int64_t>(plane);
    ClippedParts parts;
    for (std::size_t i = 0; i < 3; ++i) {
        const Coordinates from = coordinates_of(mesh.vertices[corners[i]]);
        const Coordinates to = coordinates_of(mesh.vertices[corners[(i + 1) % 3]]);
        if (from[axis] <= at) parts.left.add(lanes_of(from));
        if (from[axis] >= at) parts.right.add(lanes_of(from));
        if ((from[axis] < at && at < to[axis]) || (to[axis] < at && at < from[axis])) {
            const bool is_upward = from[axis] < to[axis];
            LaneBox crossing;
            add_crossing(crossing, is_upward ? from : to, is_upward ? to : from, axis, at);
            parts.left.add(crossing);
            parts.right.add(crossing);
        }
    }
    const LaneBox box = lane_box_of(reference);
    parts.left = intersection(parts.left, box);
    parts.right = intersection(parts.right, box);
    return parts;
}

}  // namespace espalier::baker
