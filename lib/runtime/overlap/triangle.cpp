#include <runtime/overlap/rounded_shapes.hpp>

#include <runtime/kernels/triangle_triangle.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/find.hpp>

namespace espalier::detail {

namespace {

/// Its plane from both sides, and beside each edge the plane through it that is upright on the first one, cut down to
/// integers of 23 bits.
void set_planes(Rounded<Triangle>& corners) {
    const Integer3* c = corners.triangle.corner;
    const int bits = corners.fraction_bits;
    const Integer3 ab = c[1] - c[0], ac = c[2] - c[0];
    const std::int64_t size = sum_of_magnitudes(ab) + sum_of_magnitudes(ac);
    const WideVector n = wide_cross(ab, ac);
    corners.add_plane(bounding_plane({n, c[0], Int128(), size}, bits));
    corners.add_plane(bounding_plane({-n, c[0], Int128(), size}, bits));
    const std::int32_t* first = corners.planes[0].normal;
    const Integer3 upright = {first[0], first[1], first[2]};
    for (int i = 0; i < 3; ++i) {
        const Integer3& from = c[i];
        const Integer3 side = c[i == 2 ? 0 : i + 1] - from;
        WideVector out = wide_cross(side, upright);
        // The whole triangle is on one side of it, or in it.
        const Int128 third = dot(out, c[i == 0 ? 2 : i - 1] - from);
        if (Int128() < third) out = -out;
        corners.add_plane(bounding_plane({out, from, Int128(), size}, bits));
    }
}

void enclose(Rounded<Triangle>& corners) {
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = span_of(corners.triangle, k);
        corners.set_bounds(k, low, high, corners.fraction_bits);
    }
    set_planes(corners);
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const Triangle& local, Rounded<Triangle>& corners) noexcept {
    if (!is_finite(local.a) || !is_finite(local.b) || !is_finite(local.c)) return QueryStatus::invalid_argument;
    const Vec3 corner[3] = {local.a, local.b, local.c};
    float steps[3][3];
    Rounder rounder(blob);
    for (int i = 0; i < 3; ++i) rounder.add_point(corner[i], steps[i]);
    bool is_away = false;
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = span_of(steps[0][k], steps[1][k], steps[2][k]);
        is_away = is_away || low > blob.extent_steps[k] + 1.0f || high < -1.0f;
    }
    if (is_away) return QueryStatus::not_found;
    if (!(rounder.reach() < shape_reach)) return QueryStatus::out_of_range;
    corners.fraction_bits = fraction_bits_for(rounder.reach(), volume_grid);
    for (int i = 0; i < 3; ++i) corners.triangle.corner[i] = to_grid(steps[i], corners.fraction_bits);
    enclose(corners);
    return QueryStatus::ok;
}

bool meets(const Rounded<Triangle>& corners, const LatticeTriangle& triangle) noexcept {
    return triangles_meet(corners.triangle, integer_triangle(triangle, corners.fraction_bits));
}

template QueryStatus find_overlaps_of<Triangle>(const BlobData&, const void*, Each&, const WalkAccuracy&);

}  // namespace espalier::detail
