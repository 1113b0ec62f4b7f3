// Shapes that move along a straight line until they touch the surface: a sphere, a capsule, an axis-aligned box.
//
// Numbers. Centre or corners, displacement and radius are rounded once onto a grid finer than the asset's lattice: to
// multiples of 2^-f lattice steps, where f <= 6 is the most for which everything, seen from the start, is below 2^24 of
// them (docs/numerics.md). That sweep is answered exactly. Whether a triangle is touched on the way, the ends included,
// is decided in integers; touching at one instant counts. `t` is a multiple of 2^-24 below the exact time of the first
// contact, and by no more than 2^-24: at t the shape does not touch the triangle yet. Of equal t the lowest storage
// index wins. The coordinates of `point` are within 14 ulp of the largest coordinate of the asset's bounds, those of
// `normal` within 4 ulp of 1, for the shape at t.
// Arguments. Any bit pattern is safe. `check_sweep` says in O(1) whether a sweep is answered; what it refuses finds
// nothing: a NaN, an infinity or a negative radius (invalid_argument); a start, a displacement or a radius of 2^34
// lattice steps or more, or an axis of a capsule longer than 2^25 of them along x, y or z, twice the size of the
// largest asset (out_of_range). Zero is a value like any other: of a radius, of a displacement, of a box's or an axis'
// length. A box whose min is above its max is empty and touches nothing.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

struct SweepHit {
    /// The shape has moved by t * displacement: 0 <= t < 1. 0 when it touches at the start already.
    float t = 0.0f;
    /// On the triangle. Of a sphere, closest to the centre; of a capsule, closest to the axis; of a box, the middle of
    /// what of the triangle is in the box, which is grown by what it moves within 2^-24 of the way and by 2^-19 of the
    /// distance from its farthest corner to the triangle's.
    Vec3 point;
    /// Unit, from the surface towards the shape: from `point` to the centre or the axis. Of a box the axis that is the
    /// last to separate: a face's, then the triangle's normal, then a product of edges.
    Vec3 normal;
    Triangle triangle;
    /// It touches at the start: then `triangle` is the one of the lowest storage index that it touches there, `point`
    /// is the closest to the shape's middle, and `normal` leads from there to the middle. Where that is one point, and
    /// where a sphere's centre is on the triangle otherwise, the normal is the triangle's, on the side against the
    /// displacement.
    bool starts_overlapping = false;
};

/// The first contact on the way from the start by `displacement`. `hit` is untouched when there is none. The filter
/// says of a triangle whether it counts; it may be called for triangles that are touched later, in no promised order.
bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, SweepHit& hit, TriangleFilter filter);
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, SweepHit& hit, TriangleFilter filter);
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit) noexcept;
bool sweep(const Blob& blob, const Box& box, Vec3 displacement, SweepHit& hit, TriangleFilter filter);

/// Whether such a sweep is answered: ok, invalid_argument or out_of_range.
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement) noexcept;
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement) noexcept;
[[nodiscard]] QueryStatus check_sweep(const Blob& blob, const Box& box, Vec3 displacement) noexcept;

}  // namespace espalier
