// Shapes that touch a triangle where they start: how deep they are in it, and whether they leave it.
#include <runtime/kernels/way_out.hpp>
#include <runtime/sweeps/queries.hpp>

namespace espalier::detail {

namespace {

/// What a box takes up along an axis: it has one corner and three edges from there.
struct EdgesOfBox {
    Integer3 corner;
    Integer3 edge[3];

    [[nodiscard]] Span<Int128> along(const WideVector& axis) const {
        Span<Int128> span = {dot(axis, corner), dot(axis, corner)};
        for (const Integer3& each : edge) {
            const Int128 way = dot(axis, each);
            (way.is_negative() ? span.low : span.high) += way;
        }
        return span;
    }
};

/// Tries all directions that can separate a box and a triangle: normals of faces, and products of edges and sides.
WayOut way_out_of_box(const EdgesOfBox& box, const LatticeTriangle& triangle, int fraction_bits) {
    const IntegerTriangle seen = integer_triangle(triangle, fraction_bits);
    WayOut best;
    for (int number = -1; number < 12; ++number) {
        const int i = number / 4, side = number % 4 - 1;
        const WideVector axis = number < 0 ? wide_normal_of(triangle)
                                : side < 0 ? wide_cross(box.edge[i == 2 ? 0 : i + 1], box.edge[i == 0 ? 2 : i - 1])
                                           : wide_cross(box.edge[i], side_from(triangle, side));
        try_way(axis, box.along(axis), seen.corner, best);
    }
    return best;
}

/// Tries the normal of the triangle, those of its sides in its plane, and the coordinate axes.
WayOut way_out_of_hull(const HullSweep& sweep, const LatticeTriangle& triangle) {
    const IntegerTriangle seen = integer_triangle(triangle, sweep.fraction_bits);
    const Integer3 normal = normal_of(integer_triangle(triangle));
    WayOut best;
    for (int number = -1; number < 6; ++number) {
        Integer3 unit = {0, 0, 0};
        unit[number / 2] = 1;
        const WideVector axis = number < 0        ? wide_normal_of(triangle)
                                : number % 2 == 0 ? wide_cross(normal, side_from(triangle, number / 2))
                                                  : WideVector{unit.x, unit.y, unit.z};
        Span<Int128> span{};
        for (unsigned i = 0; i < sweep.moving.point_count; ++i) {
            const auto& point = sweep.moving.point[i];
            const Int128 at = dot(axis, Integer3{point[0], point[1], point[2]});
            if (i == 0 || at < span.low) span.low = at;
            if (i == 0 || span.high < at) span.high = at;
        }
        try_way(axis, span, seen.corner, best);
    }
    return best;
}

WayOut way_out_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle) {
    const Integer3 size = sweep.high - sweep.low;
    return way_out_of_box({sweep.low, {{size.x, 0, 0}, {0, size.y, 0}, {0, 0, size.z}}}, triangle, sweep.fraction_bits);
}
WayOut way_out_at_start(const HullSweep& sweep, const LatticeTriangle& triangle) {
    if (!sweep.is_box) return way_out_of_hull(sweep, triangle);
    const auto corner = [&](unsigned i) {
        const auto& at = sweep.moving.point[i];
        return Integer3{at[0], at[1], at[2]};
    };
    const Integer3 first = corner(0);
    return way_out_of_box({first, {corner(1) - first, corner(2) - first, corner(4) - first}}, triangle,
                          sweep.fraction_bits);
}

template <class Sweep>
bool leaves_along_way_out(const Sweep& sweep, const LatticeTriangle& triangle) {
    const WayOut out = way_out_at_start(sweep, triangle);
    return !is_zero(out.axis) && !dot(out.axis, sweep.displacement).is_negative();
}

}  // namespace

float gap_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle) {
    const UnitSegment axis = sweep.axis();
    const SegmentDistance distance = distance_to(axis, triangle);
    return distance.squared > 0.0f ? distance.squared : -way_out(axis, triangle).depth;
}
float gap_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle) {
    return -way_out_at_start(sweep, triangle).depth;
}
float gap_at_start(const HullSweep& sweep, const LatticeTriangle& triangle) {
    return -way_out_at_start(sweep, triangle).depth;
}

bool leaves_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle) {
    return leaves_at_start(sweep.moving, sweep.seen_from(sweep.from, triangle));
}
bool leaves_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle) {
    return leaves_along_way_out(sweep, triangle);
}
bool leaves_at_start(const HullSweep& sweep, const LatticeTriangle& triangle) {
    return leaves_along_way_out(sweep, triangle);
}

}  // namespace espalier::detail
