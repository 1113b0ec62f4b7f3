// Sweep queries: the first contact of a sphere, a capsule, a box or a convex hull that moves along a straight line.
//
// Coordinates are in the asset's local space and units. Thread safety: any number of threads may query one blob. No
// call allocates. Numerics are described at the end of this file.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The result of sweep(): converts to true if the shape touches the surface on its way. t is 1 for a miss and 0 for a
/// refusal, so that moving the shape by t * displacement is safe in any case.
struct [[nodiscard]] SweepHit {
    float t = 0.0f;    ///< 0 <= t < 1: the share of the displacement at which the shape touches; 0 if it starts so
    Vec3 point;        ///< on the triangle: closest to the sphere's center or the capsule's axis; of a Box the middle
                       ///< of the part of the triangle that it touches; of other shapes one of the points they touch
    Vec3 normal;       ///< unit length, from the surface to the shape; of a Box the axis that is the last to separate,
                       ///< of other flat-sided shapes the normal of a plane that separates until the contact
    Vec3 face_normal;  ///< unit length, pointing away from the front of the triangle; zero for one without area
    TriangleId triangle;                         ///< of equally early ones, the one with the lowest index
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the query was refused
    std::uint8_t reserved[2] = {};
    /// The shape touches at the start. Then `triangle` is the one with the lowest index of those that it touches there,
    /// `point` is the closest one to the shape's middle, and `normal` leads from there to the middle.
    bool starts_overlapping = false;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns the first contact of the shape as it moves from its place by `displacement`.
///
/// A radius, a displacement, or the size of a box, a hull or an axis may be 0. A Box whose min is above its max and a
/// hull without vertices are empty and touch nothing. Only triangles that the filter keeps count. A hull moves and does
/// not turn: its vertices are where it starts.
///
/// Refuses a blob that is not open (not_open); a NaN, an infinity, a negative radius or a hull with more than
/// max_hull_vertices vertices (invalid_argument); a start, a displacement or a radius of 2^34 lattice steps or more,
/// or of 2^30 for an OrientedBox or a hull, and a capsule whose axis is longer than 2^25 steps along x, y or z
/// (out_of_range). Refusals cost O(1), those of a hull O(vertices). Cost: expected O(log n) for a short way;
/// docs/queries.md, Bounded, has the bound.
SweepHit sweep(const Blob& blob, const Sphere& sphere, Vec3 displacement, TriangleFilter filter = {}) noexcept;
SweepHit sweep(const Blob& blob, const Capsule& capsule, Vec3 displacement, TriangleFilter filter = {}) noexcept;
SweepHit sweep(const Blob& blob, const Box& box, Vec3 displacement, TriangleFilter filter = {}) noexcept;
SweepHit sweep(const Blob& blob, const OrientedBox& box, Vec3 displacement, TriangleFilter filter = {}) noexcept;
SweepHit sweep(const Blob& blob, const ConvexHull& hull, Vec3 displacement, TriangleFilter filter = {}) noexcept;

}  // namespace espalier

// Numerics
//
// Rounding. Center, corners or vertices, half axes, displacement and radius are rounded once onto a grid finer than the
// asset's lattice: to multiples of 2^-f lattice steps, where f <= 6 is the largest for which everything, measured from
// the start, is below 2^24 of them (docs/numerics.md). The rounded sweep is answered exactly. A sweep that continues at
// a contact is rounded anew and may start with an overlap: rounding_error() with a displacement bounds how far to move
// away before. docs/queries.md has an example, Slide along a surface.
//
// Contact. Whether a triangle is touched on the way, the ends included, is decided in integers; touching at one instant
// counts. `t` is a multiple of 2^-24 below the exact time of the first contact, and by no more than 2^-24: at t the
// rounded shape does not touch the triangle yet.
//
// Results. The coordinates of `point` are within 14 ulp of the largest coordinate of the asset's bounds, those of the
// normals within 4 ulp of 1, for the shape at t. The part of a triangle that a box touches is that in the box grown by
// 2^-24 of its way and by 2^-19 of the distance from its farthest corner to the triangle's.
//
// Normal of a Box: a face's, then the triangle's, then a product of edges. If a shape's middle lies on the triangle,
// the normal is the triangle's, on the side against the displacement.
//
// Oriented boxes and hulls. The normal is that of a plane that has the rounded shape on one side until it touches, and
// the triangle on the other; the point is one that both have in common at the exact time. Where several are right, the
// choice is the same on every machine, but may change with a version.
