#include <runtime/kernels/way_out.hpp>

namespace espalier::detail {

void try_way(const WideVector& axis, const Span<Int128>& of_shape, const Integer3* corner, WayOut& best) noexcept {
    if (is_zero(axis)) return;
    const Span<Int128> of_triangle = span_of(dot(axis, corner[0]), dot(axis, corner[1]), dot(axis, corner[2]));
    const Vec3 rounded = to_vector(axis);
    const float size = largest(rounded);
    const Vec3 scaled = rounded * (1.0f / size);
    const float length = square_root(dot(scaled, scaled));
    const Vec3 unit = scaled * (1.0f / length);
    for (const bool is_turned : {false, true}) {
        const Int128 way = is_turned ? of_shape.high - of_triangle.low : of_triangle.high - of_shape.low;
        const float depth = to_float(way) / size / length;
        if (is_zero(best.axis) || depth < best.depth)
            best = {unit * (is_turned ? -1.0f : 1.0f), depth, is_turned ? -axis : axis};
    }
}

WayOut way_out(const UnitSegment& segment, const LatticeTriangle& triangle) noexcept {
    const Integer3 along = segment.to - segment.from;
    Integer3 corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = corner_on_grid(triangle, i, segment.fraction_bits) - segment.from;
    WayOut best;
    for (int side = -1; side < 3; ++side) {
        const WideVector axis = side < 0 ? wide_normal_of(triangle) : wide_cross(along, side_from(triangle, side));
        const Int128 end = dot(axis, along), zero = 0;
        const Span<Int128> of_segment = {end.is_negative() ? end : zero, end.is_negative() ? zero : end};
        try_way(axis, of_segment, corner, best);
    }
    best.depth *= power_of_two(-segment.fraction_bits);
    return best;
}

}  // namespace espalier::detail
