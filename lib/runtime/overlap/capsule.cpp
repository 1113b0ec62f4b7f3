#include <runtime/overlap/rounded_shapes.hpp>

#include <runtime/kernels/segment_triangle.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/find.hpp>

namespace espalier::detail {

namespace {

/// The least whole number of steps that is surely no less: floats are off by less than the 2^-20 added.
std::int64_t round_outward(float steps) {
    const float more = steps * (1.0f + 0x1p-20f);
    return more < static_cast<float>(bounds_limit) * 4.0f ? to_integer(more) + 1 : std::int64_t{bounds_limit} * 4;
}

/// Bounds of the segment, grown by the radius.
void set_bounds(Rounded<Capsule>& capsule) {
    const RoundedSegment& s = capsule.segment;
    const std::int64_t reach = round_outward(capsule.radius);
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = span_of(s.from[k], s.from[k], s.to[k]);
        capsule.bounds.low[k] = clamp_to_bounds((low >> s.fraction_bits) - reach);
        capsule.bounds.high[k] = clamp_to_bounds(-(-high >> s.fraction_bits) + reach);
    }
}

float inner(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// What floats are sure of: 1 within the radius, -1 not, 0 neither. No square is a sum of more than eight roundings of
/// numbers below `size`, so that distances are off by less than `doubt` (docs/numerics.md).
ESPALIER_SHARED_CODE int guess(const Rounded<Capsule>& capsule, const LatticeTriangle& triangle) {
    const RoundedSegment& s = capsule.segment;
    float along[3], corner[3][3];  // seen from the segment's start
    float size = capsule.radius;
    for (int k = 0; k < 3; ++k) {
        along[k] = s.to_steps[k] - s.from_steps[k];
        size += absolute(along[k]);
        for (int i = 0; i < 3; ++i) {
            corner[i][k] = static_cast<float>(triangle.corner[i][k]) - s.from_steps[k];
            size += absolute(corner[i][k]);
        }
    }
    if (!(size < 0x1p40f)) return 0;
    const float doubt = size * 0x1p-18f;
    // How far each corner is from some point of the segment, the closest one but for rounding.
    float least = infinity;
    float apart[3] = {};
    const float length = inner(along, along);
    for (const auto& at : corner) {
        const float share = inner(at, along);
        const float t = share <= 0.0f ? 0.0f : share < length ? share / length : 1.0f;
        const float off[3] = {at[0] - t * along[0], at[1] - t * along[1], at[2] - t * along[2]};
        const float squared = inner(off, off);
        if (squared < least) {
            least = squared;
            for (int k = 0; k < 3; ++k) apart[k] = off[k];
        }
    }
    if (!(least >= 0x1p-20f)) return 0;
    const float distance = square_root(least);
    if (distance + doubt < capsule.radius) return 1;
    // That direction separates when all of the triangle is farther along it than all of the segment, and the radius.
    const float end = inner(along, apart);
    const float segment_reaches = end > 0.0f ? end : 0.0f;
    float begins = infinity;
    for (const auto& at : corner) begins = minimum(inner(at, apart), begins);
    return begins - segment_reaches > (capsule.radius + doubt) * (distance + doubt) ? -1 : 0;
}

/// For each axis of space two planes along the segment and that axis: a long capsule is narrower than its bounds.
void set_side_planes(Rounded<Capsule>& capsule) {
    const RoundedSegment& s = capsule.segment;
    const Integer3 along = s.to - s.from;
    const std::int64_t reach = round_outward(capsule.radius) << s.fraction_bits;
    const std::int64_t size = sum_of_magnitudes(along) + 3 * reach;
    const Integer3 normals[3] = {{0, along.z, -along.y}, {-along.z, 0, along.x}, {along.y, -along.x, 0}};
    for (int k = 0; k < 3; ++k) {
        const Integer3& n = normals[k];
        const float squared = to_float(dot<Int128>(n, n));
        const float length = squared > 0.0f ? square_root(squared) * (1.0f + 0x1p-20f) : 0.0f;
        const Int128 width = multiply(to_integer(length) + 1, reach);
        for (const Integer3& out : {n, -n})
            capsule.add_plane(bounding_plane({{out.x, out.y, out.z}, s.from, width, size}, s.fraction_bits));
    }
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const Capsule& local, Rounded<Capsule>& capsule) noexcept {
    if (!is_radius(local.radius)) return QueryStatus::invalid_argument;
    const QueryStatus status = round_segment(blob, {local.from, local.to}, capsule.segment);
    if (status != QueryStatus::ok) return status;
    capsule.radius = radius_in_steps(blob, local.radius);
    capsule.bounded = capsule.radius < static_cast<float>(bounds_limit);
    if (capsule.bounded) {
        set_bounds(capsule);
        set_side_planes(capsule);
    }
    return QueryStatus::ok;
}

bool meets(const Rounded<Capsule>& capsule, const LatticeTriangle& triangle) noexcept {
    if (capsule.bounded) {  // the distance takes long
        if (is_beside(capsule.bounds, triangle.corner)) return false;
        if (const int sure = guess(capsule, triangle); sure != 0) return sure > 0;
    }
    return is_within_radius(capsule.segment, triangle, distance_to(capsule.segment, triangle), capsule.radius);
}

template QueryStatus find_overlaps_of<Capsule>(const BlobData&, const void*, Each&, const WalkAccuracy&);

}  // namespace espalier::detail
