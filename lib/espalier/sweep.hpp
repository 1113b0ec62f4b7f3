// Sweep queries: the first contact of a sphere, a capsule, a box or a convex hull that moves along a straight line.
//
// Coordinates are in the blob's local space and units. Any number of threads may query the same blob, and no call
// allocates. Numerics are described at the end of this file.
#pragma once

#include <concepts>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The result of sweep(). Converts to true if the shape touches the surface on its way. A miss has a t of 1 and a
/// refusal a t of 0, so moving the shape by t * displacement is always safe if the displacement is finite.
struct [[nodiscard]] SweepHit {
    float t = 0.0f;  ///< 0 <= t < 1: the fraction of the displacement after which the shape stops, at the contact or a
                     ///< skin before it. Also 0 where it starts in contact or within the skin
    Vec3 point;   ///< on the triangle: closest to the sphere's center or the capsule's axis; for a Box, the middle of
                  ///< the part of the triangle that it touches; for other shapes, one of the points they touch
    Vec3 normal;  ///< unit length, from the surface to the shape; for a Box, the axis that is the last to separate; for
                  ///< other flat-sided shapes, the normal of a plane that separates them until the contact
    Vec3 face_normal;     ///< unit length, pointing away from the triangle's front; zero for a triangle without area
    TriangleId triangle;  ///< of those touched equally early, the one with the lowest index
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the query was refused
    Feature feature = Feature::face;             ///< the part of the triangle that contains `point`
    std::uint8_t reserved = 0;
    /// Whether the shape already touches at the start. Then `triangle` is the one that it penetrates most deeply, or
    /// the lowest of those with equal depth; `point` is the point of it closest to the shape's middle, and `normal`
    /// leads from there to the middle.
    bool starts_overlapping = false;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Selects the triangles that a sweep considers, and where the shape stops. Use it as a parameter only, since it refers
/// to the callable of the filter.
struct SweepOptions {
    TriangleFilter filter = {};  ///< considers only the triangles that it keeps
    /// `back` ignores triangles that show their back, dot(displacement, normal) > 0; `front` ignores those with
    /// dot(displacement, normal) < 0. A displacement of zero, or one in the plane of a triangle, ignores neither.
    FaceCulling culling = FaceCulling::none;
    /// Ignores triangles that the shape touches at the start if the displacement leads it no deeper into them. For a
    /// sphere or a capsule this means that the center or axis does not touch the triangle and comes no nearer to it;
    /// for other shapes, that the displacement does not run against the shortest way out of the triangle.
    bool ignore_leaving = false;
    /// A length of 0 or more by which the shape stops early: it keeps this distance from the plane that passes through
    /// the contact and is perpendicular to its normal, or stays at the start if it is nearer there. Since it is a plane
    /// and not the triangle, a shape that grazes an edge may stop much farther away than the skin. A skin does not push
    /// the shape away, nor does it keep the shape from a surface that the sweep misses.
    float skin = 0.0f;
};

/// Returns the first contact of the shape as it moves from where it is by `displacement`.
///
/// A radius, a displacement, and the size of a box, a hull or an axis may be 0. A Box whose min exceeds its max and a
/// hull without vertices are empty and touch nothing. Only the triangles that the options select are considered. A hull
/// moves without turning; its vertices give its position at the start.
///
/// Refuses a blob that is not open (not_open); a NaN, an infinity, a negative radius or skin, or a hull of more than
/// max_hull_vertices vertices (invalid_argument); and a start, a displacement or a radius of 2^34 lattice steps or more
/// (2^30 for an OrientedBox or a hull), or a capsule whose axis is longer than 2^25 steps along x, y or z
/// (out_of_range). A refusal costs O(1), or O(vertices) for a hull. Expected cost: O(log n) for a short way, and O(k)
/// for k triangles that the shape touches at the start; for the worst case see docs/queries/README.md, Bounded.
template <SweptShape Shape>
SweepHit sweep(const Blob& blob, const Shape& shape, Vec3 displacement, const SweepOptions& options = {}) noexcept;

/// Returns the first contact with a triangle that the filter keeps.
template <SweptShape Shape, std::convertible_to<TriangleFilter> Filter>
SweepHit sweep(const Blob& blob, const Shape& shape, Vec3 displacement, Filter&& filter) noexcept {
    SweepOptions options;
    options.filter = filter;
    return sweep(blob, shape, displacement, options);
}

}  // namespace espalier

// Numerics
//
// Rounding. Center, corners or vertices, half axes, displacement and radius are rounded once, onto a grid finer than
// the asset's lattice: to multiples of 2^-f lattice steps. f <= 6 is the largest exponent for which the radius, the
// displacement and the distance along each axis from the shape to the far end of the asset's box are below 2^24 such
// multiples (docs/numerics.md). The rounded sweep is answered exactly. A
// sweep that continues from a contact is rounded anew and may start with an overlap: rounding_error() with a
// displacement bounds the skin that prevents this. For an example see docs/queries/sweeps.md, Slide along a surface.
//
// Contact. Integers decide whether a triangle is touched on the way, including both ends; touching at a single instant
// counts. `t` is a multiple of 2^-24 below the exact time of the first contact, by no more than 2^-24, so at t the
// rounded shape does not yet touch the triangle. With a skin, `t` is a multiple of 2^-24 at which the rounded shape is
// no nearer than the skin to any point of the triangle. It is farther away by at most three such ticks of the way, plus
// 2^-17 of the skin over the sine of the angle between the displacement and the plane; where that sine is below 2^-19,
// t may be 0.
//
// Options. Culling is decided in integers, and so is whether a sphere or a capsule leaves a triangle. For other shapes,
// the ways out are exact and their lengths are compared as floats, within 2^-21; the sign of the displacement along the
// shortest is then exact. For a Box and an OrientedBox, the ways out are all directions that can separate the box from
// the triangle; for a hull, they are the normal of the triangle, the normals of its sides within its plane, and the
// coordinate axes.
//
// Start. The depth of a shape in a triangle is the length of the shortest way out: for a hull along the directions
// listed under Options, for other shapes as in find_contacts(). A sphere or a capsule is the less deep the farther its
// center or axis is from the triangle. Depths are compared as floats, within 2^-21.
//
// Feature. Exact. For a sphere or a capsule, it is the feature of the point at the t without a skin, as in
// closest_point(); for a Box, the part of the triangle that is nearest along the normal; for an OrientedBox and a hull,
// the smallest part that contains the exact point. At the start it is the feature of the point.
//
// Results. Each coordinate of `point` is within 14 ulp of the largest coordinate of the asset's bounds and each
// coordinate of the normals within 4 ulp of 1, for the shape at t, or at what t would be without a skin. The part of a
// triangle that a box touches is the part inside the box grown by 2^-24 of its way and by 2^-19 of the distance from
// its farthest corner to the triangle's.
//
// Normal of a Box. The normal of a face comes first, then that of the triangle, then the product of two edges. If the
// middle of a shape lies on the triangle, the normal is the triangle's, on the side against the displacement.
//
// Oriented boxes and hulls. The normal is that of a plane that keeps the rounded shape on one side, until it touches,
// and the triangle on the other. The point is one that both share at the exact time. If there are several, every
// machine chooses the same, but the choice may change from version to version.
