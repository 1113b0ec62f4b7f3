// The kernel of two triangles' distance. Not worth a copy in every instruction set.
#include <runtime/segment_triangle.hpp>
#include <runtime/triangle_distance.hpp>
#include <runtime/triangle_triangle.hpp>

namespace espalier::detail {

namespace {

/// Side `number` of a triangle, from that corner to the next.
UnitSegment side_of(const LatticeTriangle& triangle, int number) {
    const std::int32_t* from = triangle.corner[number];
    const std::int32_t* to = triangle.corner[number == 2 ? 0 : number + 1];
    UnitSegment side{};
    for (int k = 0; k < 3; ++k) {
        side.from[k] = from[k];
        side.to[k] = to[k];
    }
    return side;
}

/// The weights of corners b and c at a share of a side.
void weights_on_side(int number, float share, float* weights) {
    const float rest = 1.0f - share;
    weights[0] = number == 0 ? share : number == 1 ? rest : 0.0f;
    weights[1] = number == 0 ? 0.0f : number == 1 ? share : rest;
}

}  // namespace

namespace {

/// Seen from corner `number` of the one: the other.
OriginRelative from_corner(const LatticeTriangle& one, int number, const LatticeTriangle& other) {
    OriginRelative seen{};
    const auto set = [&](int k, std::int64_t Integer3::*axis) {
        const auto& c = other.corner;
        seen.a.*axis = std::int64_t{c[0][k]} - one.corner[number][k];
        seen.ab.*axis = std::int64_t{c[1][k]} - c[0][k];
        seen.ac.*axis = std::int64_t{c[2][k]} - c[0][k];
    };
    set(0, &Integer3::x);
    set(1, &Integer3::y);
    set(2, &Integer3::z);
    return seen;
}

/// Out of line: what it needs must not lie on the stack below the other kernels.
[[gnu::noinline]] bool share_a_point(const LatticeTriangle& a, const LatticeTriangle& b) {
    return triangles_meet(integer_triangle(a), integer_triangle(b));
}

/// Six sides against the other triangle each: places are looked at more than once, but a common point is found.
[[gnu::noinline]] TriangleDistance distance_of_touching(const LatticeTriangle& a, const LatticeTriangle& b) {
    TriangleDistance best;
    best.squared = infinity;
    for (int number = 0; number < 6 && best.squared != 0.0f; ++number) {
        const bool of_a = number < 3;
        const int side = of_a ? number : number - 3;
        const SegmentDistance distance = distance_to(side_of(of_a ? a : b, side), of_a ? b : a);
        if (!(distance.squared < best.squared)) continue;
        best.squared = distance.squared;
        weights_on_side(side, distance.along, of_a ? best.on_a : best.on_b);
        float* const face = of_a ? best.on_b : best.on_a;
        face[0] = distance.u;
        face[1] = distance.v;
    }
    return best;
}

}  // namespace

namespace {

/// Six corners, and the insides of nine pairs of sides.
[[gnu::noinline]] TriangleDistance distance_of_apart(const LatticeTriangle& a, const LatticeTriangle& b) {
    TriangleDistance best;
    best.squared = infinity;
    for (int number = 0; number < 6; ++number) {
        const bool of_a = number < 3;
        const int corner = of_a ? number : number - 3;
        const PointDistance distance = distance_to(from_corner(of_a ? a : b, corner, of_a ? b : a), 0);
        if (!(distance.squared < best.squared)) continue;
        best.squared = distance.squared;
        weights_on_side(corner, 0.0f, of_a ? best.on_a : best.on_b);
        float* const face = of_a ? best.on_b : best.on_a;
        face[0] = distance.u;
        face[1] = distance.v;
    }
    for (int side = 0; side < 3; ++side) {
        const SegmentDistance distance = distance_to_sides(side_of(a, side), b);
        if (!(distance.squared < best.squared)) continue;
        best.squared = distance.squared;
        weights_on_side(side, distance.along, best.on_a);
        best.on_b[0] = distance.u;
        best.on_b[1] = distance.v;
    }
    return best;
}

}  // namespace

TriangleDistance distance_between(const LatticeTriangle& a, const LatticeTriangle& b) noexcept {
    return share_a_point(a, b) ? distance_of_touching(a, b) : distance_of_apart(a, b);
}

bool is_within_radius(const LatticeTriangle& a, const LatticeTriangle& b, const TriangleDistance& distance,
                      float radius) noexcept {
    const float squared = radius * radius;
    if (distance.squared > squared * distance_slack) return false;
    if (distance.squared * distance_slack < squared || distance.squared == 0.0f) return true;
    // Which of the six is the least is known to some ulp only: one of them decides.
    for (int number = 0; number < 6; ++number) {
        const UnitSegment side = side_of(number < 3 ? a : b, number % 3);
        const LatticeTriangle& face = number < 3 ? b : a;
        const SegmentDistance nearest = distance_to(side, face);
        if (is_within_radius(side, face, nearest, radius)) return true;
    }
    return false;
}

}  // namespace espalier::detail
