// The kernel of two triangles' distance. Not worth a copy in every instruction set. Widths: docs/numerics.md.
#include <runtime/kernels/segment_places.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/kernels/triangle_triangle.hpp>

namespace espalier::detail {

namespace {

/// Returns the distance that a place on side `number` of the one triangle gives, or the corner where the side begins.
TriangleDistance distance_at(const SegmentDistance& place, bool of_a, int number) {
    const Weights on_side = weights_on_side(number, place.along), on_face = {place.u, place.v};
    return {place.squared, of_a ? on_side : on_face, of_a ? on_face : on_side};
}

/// Where triangles that share no point may be nearest: six corners, and the insides of nine pairs of sides. Keeps the
/// nearest place; given a radius, decides for each exactly whether it is within.
class Places {
public:
    Places(const LatticeTriangle& a, const LatticeTriangle& b, TriangleDistance& nearest, float radius = -1.0f)
        : a_(a), b_(b), nearest_(nearest), places_(0, radius) {
        nearest_.squared = infinity;
    }

    /// Whether one is within the radius.
    bool try_all() {
        for (int number = 0; number < 6; ++number) try_corner(number);
        for (int number = 0; number < 9; ++number) try_sides(number / 3, number % 3);
        return places_.is_any_within();
    }

private:
    ESPALIER_NOINLINE void try_corner(int number) {
        const bool of_a = number < 3;
        const int corner = of_a ? number : number - 3;
        places_.try_end(relative_to((of_a ? a_ : b_).corner[corner], 0, of_a ? b_ : a_), 0.0f);
        keep_nearer(of_a, corner);
    }
    /// Steps from one corner to another are below 2^26 along each axis: products of two fit 64 bits.
    ESPALIER_NOINLINE void try_sides(int a_side, int b_side) {
        const Integer3 d = side_from(a_, a_side);
        const Integer3 between = corner_on_grid(b_, b_side, 0) - corner_on_grid(a_, a_side, 0);
        places_.try_side<std::int64_t, Int128>(between, dot<std::int64_t>(between, d), side_from(b_, b_side), d,
                                               dot<std::int64_t>(d, d), b_side);
        keep_nearer(true, a_side);
    }
    void keep_nearer(bool of_a, int number) {
        const SegmentDistance& place = places_.nearest();
        if (place.squared < nearest_.squared) nearest_ = distance_at(place, of_a, number);
    }

    const LatticeTriangle& a_;
    const LatticeTriangle& b_;
    TriangleDistance& nearest_;
    SegmentPlaces places_;
};

/// Six sides against the other triangle each: places are looked at more than once, but a common point is found.
ESPALIER_NOINLINE TriangleDistance distance_of_touching(const LatticeTriangle& a, const LatticeTriangle& b) {
    TriangleDistance best;
    best.squared = infinity;
    for (int number = 0; number < 6 && best.squared != 0.0f; ++number) {
        const bool of_a = number < 3;
        const int side = of_a ? number : number - 3;
        const LatticeTriangle& own = of_a ? a : b;
        const UnitSegment segment = {corner_on_grid(own, side, 0), corner_on_grid(own, side == 2 ? 0 : side + 1, 0), 0};
        const SegmentDistance distance = distance_to(segment, of_a ? b : a);
        if (distance.squared < best.squared) best = distance_at(distance, of_a, side);
    }
    return best;
}

}  // namespace

void find_distance_if_apart(const LatticeTriangle& a, const LatticeTriangle& b, TriangleDistance& distance) noexcept {
    if (triangles_meet(a, b)) distance = {};
    else Places(a, b, distance).try_all();
}

TriangleDistance distance_between(const LatticeTriangle& a, const LatticeTriangle& b) noexcept {
    if (triangles_meet(a, b)) return distance_of_touching(a, b);
    TriangleDistance distance;
    Places(a, b, distance).try_all();
    return distance;
}

bool is_within_radius(const LatticeTriangle& a, const LatticeTriangle& b, const TriangleDistance& distance,
                      float radius) noexcept {
    if (const int sure = sure_within(distance.squared, radius); sure != 0) return sure > 0;
    // Which place is the nearest is known to some ulp only: one of them decides.
    TriangleDistance nearest;
    return Places(a, b, nearest, radius).try_all();
}

}  // namespace espalier::detail
