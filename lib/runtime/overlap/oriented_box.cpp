#include <runtime/overlap/rounded_shapes.hpp>

#include <runtime/kernels/ray_triangle.hpp>
#include <runtime/lattice/rounder.hpp>
#include <runtime/overlap/bounding_plane.hpp>
#include <runtime/overlap/find.hpp>

#if !ESPALIER_SMALL_CODE
#define ESPALIER_FRAGMENT <runtime/overlap/oriented_box_queries.hpp>
#include <runtime/lanes/for_each_set.hpp>
#endif

namespace espalier::detail {

void add_faces(Rounded<OrientedBox>& box) noexcept {
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1, k = i == 0 ? 2 : i - 1;
        box.face[i] = wide_cross(box.half[j], box.half[k]);
    }
    box.face_reach = magnitude(dot(box.face[0], box.half[0]));
}

QueryStatus round_half_axes(const BlobData& blob, const OrientedBox& local, Rounded<OrientedBox>& box) noexcept {
    if (!is_finite(local)) return QueryStatus::invalid_argument;
    Rounder rounder(blob);
    const OrientedBoxInSteps steps(local, rounder);
    if (steps.is_away(blob, 0.0f)) return QueryStatus::not_found;
    const float reach = rounder.reach();
    if (!(reach < shape_reach)) return QueryStatus::out_of_range;
    box.is_near = exponent_of(reach) <= volume_grid;
    box.fraction_bits = fraction_bits_for(reach, volume_grid);
    to_grid(steps.center, box.fraction_bits, box.center, box.center_steps);
    for (int i = 0; i < 3; ++i) to_grid(steps.half[i], box.fraction_bits, box.half[i], box.half_steps[i]);
    for (int k = 0; k < 3; ++k) {
        std::int64_t side = 0;
        for (const Integer3& half : box.half) side += magnitude(half[k]);
        box.set_bounds(k, box.center[k] - side, box.center[k] + side, box.fraction_bits);
    }
    return QueryStatus::ok;
}

QueryStatus round_volume(const BlobData& blob, const OrientedBox& local, Rounded<OrientedBox>& box) noexcept {
    const QueryStatus status = round_half_axes(blob, local, box);
    if (status != QueryStatus::ok) return status;
    add_faces(box);
    if constexpr (small_code) {
        std::int64_t size = 0;
        for (const Integer3& half : box.half) size += sum_of_magnitudes(half);
        for (const WideVector& face : box.face)
            for (const WideVector& normal : {face, -face})
                box.add_plane(bounding_plane({normal, box.center, box.face_reach, size}, box.fraction_bits));
        box.planes_cull = blob.copies == nullptr;  // as in oriented_box_queries.hpp
    }
    return QueryStatus::ok;
}

namespace {

/// Corners seen from the box's center, in its units; sides in lattice steps.
struct Seen {
    Integer3 corner[3];
    Integer3 side[3];
};

/// Whether three numbers are all beyond the same end of [-reach, reach].
template <class Number>
bool are_beyond(const Number* at, Number reach) {
    return (reach < at[0] && reach < at[1] && reach < at[2]) || (at[0] < -reach && at[1] < -reach && at[2] < -reach);
}

template <class Vector>
bool are_apart_along(const Vector& axis, const Rounded<OrientedBox>& box, const Seen& seen) {
    using Number = decltype(dot(axis, box.center));
    Number at[3];
    Number reach = 0;
    for (int i = 0; i < 3; ++i) {
        at[i] = dot(axis, seen.corner[i]);
        reach = reach + magnitude(dot(axis, box.half[i]));
    }
    return are_beyond(at, reach);
}
bool is_separated_along(const Integer3& axis, const Rounded<OrientedBox>& box, const Seen& seen) {
    return are_apart_along(axis, box, seen);
}
/// Called, not copied: rare, and large.
ESPALIER_NOINLINE bool is_separated_along(const WideVector& axis, const Rounded<OrientedBox>& box, const Seen& seen) {
    return are_apart_along(axis, box, seen);
}

/// All axes but those of the box's faces. Narrow vectors do for boxes near the asset and short sides.
template <class Vector>
ESPALIER_NOINLINE bool is_separated(const Rounded<OrientedBox>& box, const Seen& seen) {
    const auto is_across = [&](const Integer3& a, const Integer3& b) {
        return is_separated_along(cross_in<Vector>(a, b), box, seen);
    };
    if (is_across(seen.side[0], seen.side[1])) return true;
    for (const Integer3& half : box.half)
        for (const Integer3& side : seen.side)
            if (is_across(half, side)) return true;
    if (!box.face_reach.is_zero()) return false;
    // Without volume: normals of each direction within whichever plane all may lie in.
    constexpr Integer3 units[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const Integer3& unit : units) {
        for (int i = 0; i < 3; ++i)
            if (is_across(unit, box.half[i]) || is_across(unit, seen.side[i])) return true;
    }
    return false;
}

}  // namespace

bool meets(const Rounded<OrientedBox>& box, const LatticeTriangle& triangle) noexcept {
    Seen seen;
    for (int i = 0; i < 3; ++i) {
        seen.corner[i] = corner_on_grid(triangle, i, box.fraction_bits) - box.center;
        seen.side[i] = side_from(triangle, i);
    }
    // Only a flat box needs the axes of space; for other boxes they are a cheap first test.
    const Integer3 reach = magnitude(box.half[0]) + magnitude(box.half[1]) + magnitude(box.half[2]);
    for (int k = 0; k < 3; ++k) {
        const auto [low, high] = span_of(seen.corner[0][k], seen.corner[1][k], seen.corner[2][k]);
        if (reach[k] < low || high < -reach[k]) return false;
    }
    bool inside[3] = {true, true, true};
    for (const WideVector& normal : box.face) {
        Int128 at[3];
        for (int i = 0; i < 3; ++i) {
            at[i] = dot(normal, seen.corner[i]);
            if (box.face_reach < magnitude(at[i])) inside[i] = false;
        }
        if (are_beyond(at, box.face_reach)) return false;
    }
    if (!box.face_reach.is_zero() && (inside[0] || inside[1] || inside[2])) return true;
    const bool is_short = ray_triangle::edges_are_below<12>({{}, seen.side[0], seen.side[1]});
    return !(takes_shortcut(box.is_near && is_short) ? is_separated<Integer3>(box, seen)
                                                     : is_separated<WideVector>(box, seen));
}

template <>
QueryStatus find_overlaps_of<OrientedBox>(const BlobData& blob, const void* shape, Each& answer,
                                          const WalkAccuracy& accuracy) {
#if ESPALIER_SMALL_CODE
    return find_overlaps_in_volume<OrientedBox>(blob, shape, answer, accuracy);
#else
    Rounded<OrientedBox> box;
    const QueryStatus status = round_half_axes(blob, *static_cast<const OrientedBox*>(shape), box);
    if (status == QueryStatus::not_found) return QueryStatus::ok;
    if (status != QueryStatus::ok || blob.triangle_count == 0) return status;
    const bool is_stopped = ESPALIER_DISPATCH(find_overlaps_of_box, blob, box, answer, accuracy);
    return is_stopped ? QueryStatus::stopped : QueryStatus::ok;
#endif
}

}  // namespace espalier::detail
