// The kernel of two triangles' distance. Not worth a copy in every instruction set. Widths: docs/numerics.md.
#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/kernels/triangle_distance.hpp>
#include <runtime/kernels/triangle_triangle.hpp>

namespace espalier::detail {

namespace {

/// Side `number` of a triangle, from that corner to the next.
UnitSegment side_of(const LatticeTriangle& triangle, int number) {
    return {corner_on_grid(triangle, number, 0), corner_on_grid(triangle, number == 2 ? 0 : number + 1, 0), 0};
}

/// The weights of corners b and c at a share of a side.
void weights_on_side(int number, float share, float* weights) {
    const float rest = 1.0f - share;
    weights[0] = number == 0 ? share : number == 1 ? rest : 0.0f;
    weights[1] = number == 0 ? 0.0f : number == 1 ? share : rest;
}

/// From one corner to another: below 2^26 along each axis.
struct Step {
    std::int32_t at[3];
    Step(const std::int32_t* from, const std::int32_t* to) {
        for (int k = 0; k < 3; ++k) at[k] = to[k] - from[k];
    }
};
/// Below 2^54.
std::int64_t dot(const Step& a, const Step& b) {
    const auto product = [&](int k) { return std::int64_t{a.at[k]} * b.at[k]; };
    return product(0) + product(1) + product(2);
}
/// The volume that three steps span, below 2^81.
ESPALIER_SHARED_CODE Int128 volume_of(const Step& a, const Step& b, const Step& c) {
    const auto minor = [&](int x, int y) { return std::int64_t{b.at[x]} * c.at[y] - std::int64_t{b.at[y]} * c.at[x]; };
    const Int128 volume =
        multiply(a.at[0], minor(1, 2)) + multiply(a.at[1], minor(2, 0)) + multiply(a.at[2], minor(0, 1));
    return negate_if(volume, volume.is_negative());
}

bool is_inside(const Int128& share, const Int128& whole) { return Int128(0) < share && share < whole; }

/// Where triangles that share no point may be nearest: six corners, and the insides of nine pairs of sides. Keeps the
/// nearest place; given a radius, decides for each exactly whether it is within.
class Places {
public:
    Places(const LatticeTriangle& a, const LatticeTriangle& b, TriangleDistance& nearest, float radius = -1.0f)
        : a_(a), b_(b), nearest_(nearest), radius_(radius) {
        nearest_.squared = infinity;
    }

    /// Whether one is within the radius.
    bool try_all() {
        for (int number = 0; number < 6; ++number) try_corner(number);
        for (int number = 0; number < 9; ++number) try_sides(number / 3, number % 3);
        return within_;
    }

private:
    [[gnu::noinline]] void try_corner(int number) {
        const bool of_a = number < 3;
        const int corner = of_a ? number : number - 3;
        const PointDistance distance = distance_to(relative_to((of_a ? a_ : b_).corner[corner], 0, of_a ? b_ : a_), 0);
        if (radius_ >= 0.0f && is_within_radius(distance, 0, radius_)) within_ = true;
        if (!(distance.squared < nearest_.squared)) return;
        nearest_.squared = distance.squared;
        weights_on_side(corner, 0.0f, of_a ? nearest_.on_a : nearest_.on_b);
        float* const face = of_a ? nearest_.on_b : nearest_.on_a;
        face[0] = distance.u;
        face[1] = distance.v;
    }

    /// Between the lines of two sides, where both of the closest points are inside of them: volume^2 / denominator.
    [[gnu::noinline]] void try_sides(int a_side, int b_side) {
        const auto& a = a_.corner;
        const auto& b = b_.corner;
        const Step d(a[a_side], a[a_side == 2 ? 0 : a_side + 1]);
        const Step e(b[b_side], b[b_side == 2 ? 0 : b_side + 1]);
        const Step between(a[a_side], b[b_side]);
        const std::int64_t dd = dot(d, d), ee = dot(e, e), de = dot(d, e);
        const std::int64_t along_d = dot(between, d), along_e = dot(between, e);
        const Int128 denominator = product_difference(dd, ee, de, de);
        const Int128 along = product_difference(along_d, ee, along_e, de);
        if (!is_inside(along, denominator)) return;
        const Int128 share = product_difference(along_d, de, along_e, dd);
        if (!is_inside(share, denominator)) return;
        const Int128 volume = volume_of(between, d, e);
        if (radius_ >= 0.0f && are_sides_within(volume, denominator)) within_ = true;
        const float size = to_float(volume), whole = to_float(denominator);
        const float squared = size / whole * size;
        if (!(squared < nearest_.squared)) return;
        nearest_.squared = squared;
        weights_on_side(a_side, minimum(to_float(along) / whole, 1.0f), nearest_.on_a);
        weights_on_side(b_side, minimum(to_float(share) / whole, 1.0f), nearest_.on_b);
    }
    [[gnu::noinline]] bool are_sides_within(const Int128& volume, const Int128& denominator) const {
        return is_within_radius(Unsigned256::product(volume, volume), denominator, 0, radius_);
    }

    const LatticeTriangle& a_;
    const LatticeTriangle& b_;
    TriangleDistance& nearest_;
    float radius_;  ///< negative if there is none
    bool within_ = false;
};

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
    const float squared = radius * radius;
    if (distance.squared > squared * distance_slack) return false;
    if (distance.squared * distance_slack < squared || distance.squared == 0.0f) return true;
    // Which place is the nearest is known to some ulp only: one of them decides.
    TriangleDistance nearest;
    return Places(a, b, nearest, radius).try_all();
}

}  // namespace espalier::detail
