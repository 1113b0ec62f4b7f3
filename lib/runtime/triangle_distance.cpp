// The kernel of two triangles' distance. Not worth a copy in every instruction set.
#include <runtime/segment_triangle.hpp>
#include <runtime/triangle_distance.hpp>

namespace espalier::detail {

namespace {

/// Side `number` of a triangle, from that corner to the next.
LatticeSegment side_of(const LatticeTriangle& triangle, int number) {
    const std::int32_t* from = triangle.corner[number];
    const std::int32_t* to = triangle.corner[number == 2 ? 0 : number + 1];
    LatticeSegment side{};
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

TriangleDistance distance_between(const LatticeTriangle& a, const LatticeTriangle& b) noexcept {
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

bool is_within_radius(const LatticeTriangle& a, const LatticeTriangle& b, const TriangleDistance& distance,
                      float radius) noexcept {
    const float squared = radius * radius;
    if (distance.squared > squared * distance_slack) return false;
    if (distance.squared * distance_slack < squared || distance.squared == 0.0f) return true;
    // Which of the six is the least is known to some ulp only: one of them decides.
    for (int number = 0; number < 6; ++number) {
        const LatticeSegment side = side_of(number < 3 ? a : b, number % 3);
        const LatticeTriangle& face = number < 3 ? b : a;
        const SegmentDistance nearest = distance_to(side, face);
        if (is_within_radius(side, face, nearest, radius)) return true;
    }
    return false;
}

}  // namespace espalier::detail
