// Sweep queries: the first contact of a sphere, a capsule, a box or a convex hull that moves along a straight line.
//
// Coordinates are in the asset's local space and units. Thread safety: any number of threads may query one blob. No
// call allocates. Numerics are described at the end of this file.
#pragma once

#include <concepts>
#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The result of sweep(): converts to true if the shape touches the surface on its way. t is 1 for a miss and 0 for a
/// refusal, so that moving the shape by t * displacement is safe if the displacement is finite.
struct [[nodiscard]] SweepHit {
    float t = 0.0f;    ///< 0 <= t < 1: the share of the displacement at which the shape stops: where it touches
                       ///< or a skin earlier; 0 if it starts so
    Vec3 point;        ///< on the triangle: closest to the sphere's center or the capsule's axis; of a Box the middle
                       ///< of the part of the triangle that it touches; of other shapes one of the points they touch
    Vec3 normal;       ///< unit length, from the surface to the shape; of a Box the axis that is the last to separate,
                       ///< of other flat-sided shapes the normal of a plane that separates until the contact
    Vec3 face_normal;  ///< unit length, pointing away from the front of the triangle; zero for one without area
    TriangleId triangle;                         ///< of equally early ones, the one with the lowest index
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the query was refused
    Feature feature = Feature::face;             ///< the part of the triangle that holds `point`
    std::uint8_t reserved = 0;
    /// The shape touches at the start. Then `triangle` is the one that it is in deepest, of equally deep ones the one
    /// with the lowest index; `point` is the closest one to the shape's middle, and `normal` leads from there to the
    /// middle.
    bool starts_overlapping = false;

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Selects the triangles that count, and where the shape stops.
struct SweepOptions {
    TriangleFilter filter = {};  ///< counts the triangles that it keeps
    /// Ignores triangles that show their back: the displacement leads along their normal. `front` ignores those that it
    /// leads against. One in the plane of a triangle leads neither way.
    FaceCulling culling = FaceCulling::none;
    /// Ignores triangles that the shape touches at the start and that the displacement leads it no deeper into. For a
    /// sphere or a capsule, center and axis do not touch the triangle and come no nearer to it. For another shape, the
    /// displacement does not lead against the shortest way out of the triangle.
    bool ignore_leaving = false;
    /// Stops the shape earlier, so far from the plane through the contact across its normal, or at the start if it is
    /// nearer there. A length from 0 on. It moves no shape away, and keeps none from a surface that the sweep misses.
    float skin = 0.0f;
};

/// Returns the first contact of the shape as it moves from its place by `displacement`.
///
/// A radius, a displacement, or the size of a box, a hull or an axis may be 0. A Box whose min is above its max and a
/// hull without vertices are empty and touch nothing. Only triangles that the options leave count. A hull moves and
/// does not turn: its vertices are where it starts.
///
/// Refuses a blob that is not open (not_open); a NaN, an infinity, a negative radius or skin or a hull with more than
/// max_hull_vertices vertices (invalid_argument); a start, a displacement or a radius of 2^34 lattice steps or more,
/// or of 2^30 for an OrientedBox or a hull, and a capsule whose axis is longer than 2^25 steps along x, y or z
/// (out_of_range). Refusals cost O(1), those of a hull O(vertices). Cost: expected O(log n) for a short way, and O(k)
/// for k triangles that the shape touches at the start; docs/queries/README.md, Bounded, has the bound.
template <SweptShape Shape>
SweepHit sweep(const Blob& blob, const Shape& shape, Vec3 displacement, const SweepOptions& options = {}) noexcept;

/// Returns the first contact with a triangle that the filter keeps.
template <SweptShape Shape>
SweepHit sweep(const Blob& blob, const Shape& shape, Vec3 displacement, TriangleFilter filter) noexcept {
    SweepOptions options;
    options.filter = filter;
    return sweep(blob, shape, displacement, options);
}

}  // namespace espalier

// Numerics
//
// Rounding. Center, corners or vertices, half axes, displacement and radius are rounded once onto a grid finer than the
// asset's lattice: to multiples of 2^-f lattice steps, where f <= 6 is the largest for which everything, measured from
// the start, is below 2^24 of them (docs/numerics.md). The rounded sweep is answered exactly. A sweep that continues at
// a contact is rounded anew and may start with an overlap: rounding_error() with a displacement bounds how much skin
// prevents that. docs/queries/sweeps.md has an example, Slide along a surface.
//
// Contact. Whether a triangle is touched on the way, the ends included, is decided in integers; touching at one instant
// counts. `t` is a multiple of 2^-24 below the exact time of the first contact, and by no more than 2^-24: at t the
// rounded shape does not touch the triangle yet. With a skin, t is such a multiple that the rounded shape is no nearer
// than the skin to any point of the triangle. It is farther by no more than three ticks, 2^-24 of the way each, and
// 2^-17 of the skin over the sine of the angle between displacement and plane; where it is below 2^-19, t may be 0.
//
// Options. Culling is decided in integers, and so is whether a sphere or a capsule leaves a triangle. Of other shapes
// the ways out are exact, and their lengths are compared as floats, within 2^-21; then the sign of the displacement is
// exact. Those of a Box and an OrientedBox are all directions that can separate it from the triangle; those of a hull
// are the normals of the triangle and of its sides within its plane, and the coordinate axes.
//
// Start. How deep a shape is in a triangle is the length of the shortest way out, of a hull along the directions that
// Options names, of others as find_contacts() has it. Spheres and capsules are less deep the farther center or axis
// are from the triangle. Compared as floats, within 2^-21.
//
// Feature. Exact: of a sphere or a capsule that of the point at the t without skin, as closest_point() has it; of a Box
// what of the triangle is nearest along the normal; of an OrientedBox and a hull the smallest part with the exact
// point; at the start that of the point.
//
// Results. The coordinates of `point` are within 14 ulp of the largest coordinate of the asset's bounds, those of the
// normals within 4 ulp of 1, for the shape at t, or where t were without a skin. The part of a triangle that a box
// touches is that in the box grown by 2^-24 of its way and by 2^-19 of the distance from its farthest corner to the
// triangle's.
//
// Normal of a Box: a face's, then the triangle's, then a product of edges. If a shape's middle lies on the triangle,
// the normal is the triangle's, on the side against the displacement.
//
// Oriented boxes and hulls. The normal is that of a plane that has the rounded shape on one side until it touches, and
// the triangle on the other; the point is one that both have in common at the exact time. Where several are right, the
// choice is the same on every machine, but may change with a version.
