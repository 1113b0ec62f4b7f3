#include <runtime/overlap/rounded_shapes.hpp>

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/find.hpp>

namespace espalier::detail {

namespace {

constexpr int fine = Rounded<Box>::fraction_bits - 1;

/// From and to, in units of 2^-fine steps: at most a step beyond the asset's box, so that bounds need no clamp.
void set_sides(Rounded<Box>& box, int k, std::int64_t low, std::int64_t high) {
    box.center[k] = low + high;
    box.half[k] = high - low;
    box.bounds.low[k] = static_cast<std::int32_t>(-(-low >> fine));
    box.bounds.high[k] = static_cast<std::int32_t>(high >> fine);
    box.is_enclosure = true;
}

}  // namespace

QueryStatus round_volume(const BlobData& blob, const Box& local, Rounded<Box>& box) noexcept {
    if (is_nan(local.min) || is_nan(local.max)) return QueryStatus::invalid_argument;
    if (is_empty(local)) return QueryStatus::not_found;
    const float min[3] = {local.min.x, local.min.y, local.min.z};
    const float max[3] = {local.max.x, local.max.y, local.max.z};
    for (int k = 0; k < 3; ++k) {
        // No triangle is beyond the asset's box: a step outside of it is as good as infinitely far.
        const float last = blob.extent_steps[k] + 1.0f;
        const float low_steps = to_steps(blob, k, min[k]);
        const float high_steps = to_steps(blob, k, max[k]);
        if (low_steps > last || high_steps < -1.0f) return QueryStatus::not_found;
        // Infinity times the step of an empty blob, which may be 0, is not a number, and must not become an integer.
        set_sides(box, k, to_grid(low_steps > -1.0f ? low_steps : -1.0f, fine),
                  to_grid(high_steps < last ? high_steps : last, fine));
    }
    return QueryStatus::ok;
}

QueryStatus round_volume(const BlobData& blob, const LatticeBox& steps, Rounded<Box>& box) noexcept {
    const std::int32_t min[3] = {steps.min.x, steps.min.y, steps.min.z};
    const std::int32_t max[3] = {steps.max.x, steps.max.y, steps.max.z};
    for (int k = 0; k < 3; ++k) {
        const std::int32_t last = blob.extent[k] + 1;  // as above
        if (min[k] > max[k] || min[k] > last || max[k] < -1) return QueryStatus::not_found;
        set_sides(box, k, std::int64_t{min[k] < -1 ? -1 : min[k]} * (1 << fine),
                  std::int64_t{max[k] > last ? last : max[k]} * (1 << fine));
    }
    return QueryStatus::ok;
}

namespace {

/// Whether the triangle's plane has the box on one side. Coordinates of the corner stay below 2^33 (docs/numerics.md).
template <class Sum>
bool is_beside_plane(const Rounded<Box>& box, const OriginRelative& t) {
    const Integer3 normal = cross(t.ab, t.ac);
    const Sum distance = dot<Sum>(normal, t.a);
    const Sum reach = dot<Sum>(magnitude(normal), {box.half[0], box.half[1], box.half[2]});
    return reach < distance || distance < -reach;
}
ESPALIER_NOINLINE bool is_beside_wide_plane(const Rounded<Box>& box, const OriginRelative& t) {
    return is_beside_plane<Int128>(box, t);
}

}  // namespace

bool meets(const Rounded<Box>& box, const LatticeTriangle& triangle) noexcept {
    std::int64_t corner[3][3];  // seen from the center
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i)
            corner[i][k] = (std::int64_t{triangle.corner[i][k]} << Rounded<Box>::fraction_bits) - box.center[k];
        const auto [low, high] = span_of(corner[0][k], corner[1][k], corner[2][k]);
        if (low > box.half[k] || high < -box.half[k]) return false;
    }
    const OriginRelative t = relative_to(box.center, Rounded<Box>::fraction_bits, triangle);
    if (takes_shortcut() && ray_triangle::edges_are_below<12>(t) ? is_beside_plane<std::int64_t>(box, t)
                                                                 : is_beside_wide_plane(box, t))
        return false;
    // Each edge with each axis: seen along the axis, both ends of the edge are at one place, the third corner
    // elsewhere.
    for (int i = 0; i < 3; ++i) {
        const int to = i == 2 ? 0 : i + 1, third = i == 0 ? 2 : i - 1;
        for (int k = 0; k < 3; ++k) {
            const int x = k == 2 ? 0 : k + 1, y = k == 0 ? 2 : k - 1;
            const std::int64_t dx = triangle.corner[to][x] - triangle.corner[i][x];
            const std::int64_t dy = triangle.corner[to][y] - triangle.corner[i][y];
            const std::int64_t ends = dx * corner[i][y] - dy * corner[i][x];
            const std::int64_t other = dx * corner[third][y] - dy * corner[third][x];
            const std::int64_t reach = magnitude(dx) * box.half[y] + magnitude(dy) * box.half[x];
            if ((ends > reach && other > reach) || (ends < -reach && other < -reach)) return false;
        }
    }
    return true;
}

template QueryStatus find_overlaps_of<Box>(const BlobData&, const void*, Each&, const WalkAccuracy&);
template QueryStatus find_overlaps_of<LatticeBox>(const BlobData&, const void*, Each&, const WalkAccuracy&);

}  // namespace espalier::detail
