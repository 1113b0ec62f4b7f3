// The shapes that queries take, in the units and axes of the baked mesh.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include <espalier/types.hpp>

namespace espalier {

/// The points between two points, both included.
struct Segment {
    Vec3 from;
    Vec3 to;
};

/// All points within `radius` of the center. With a radius of 0 it is a point.
struct Sphere {
    Vec3 center;
    float radius = 0.0f;
};

/// All points within `radius` of the segment from `from` to `to`. With from == to it is a sphere.
struct Capsule {
    Vec3 from;
    Vec3 to;
    float radius = 0.0f;
};

/// An axis-aligned box. Empty where a coordinate of `min` is above that of `max`; flat ones and points are boxes too.
struct Box {
    Vec3 min;
    Vec3 max;
};

/// A box of any orientation: each half axis leads from the center to the middle of a face. Half axes may be zero, and
/// need not be perpendicular: a sheared box is valid.
struct OrientedBox {
    Vec3 center;
    Vec3 half_axes[3];
};

/// The convex hull of `apex` and a disc: a spot light, a field of view. The disc has its center at apex + axis, is
/// perpendicular to the axis, and has this radius: length(axis) * tan(half of the opening angle). A radius of 0 makes
/// the cone a segment.
///
/// Queries refuse an infinite radius and an axis shorter than 2^-17 of the grid, about 2^-23 lattice steps
/// (invalid_argument), and an apex that is 2^36 lattice steps away or an axis of that length (out_of_range).
struct Cone {
    Vec3 apex;
    Vec3 axis;
    float radius = 0.0f;
};

/// The half-space dot(normal, x) <= offset. The normal points outward and may have any length but zero.
struct Plane {
    Vec3 normal;
    float offset = 0.0f;
};

/// The largest number of planes of a ConvexVolume: 26-DOPs fit.
inline constexpr std::size_t max_planes = 32;

/// All points behind each of the planes: a frustum, a k-DOP. It need not be bounded; without planes it is all of space.
/// The planes must outlive it.
struct ConvexVolume {
    std::span<const Plane> planes;
};

/// The largest number of vertices of a ConvexHull.
inline constexpr std::size_t max_hull_vertices = 64;

/// The convex hull of vertices: sweep() and find_contacts() take it. They may stand in any order, be repeated, lie
/// inside of the hull, in one plane or on one line. Without vertices it is empty. The vertices must outlive it.
struct ConvexHull {
    std::span<const Vec3> vertices;
};

struct LatticeBox;  // lattice.hpp

/// A shape that overlaps(), for_each_overlap() and collect_overlaps() take. Triangle is declared in types.hpp.
template <class Shape>
concept OverlapShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OrientedBox> || std::same_as<Shape, Triangle> || std::same_as<Shape, ConvexVolume> ||
    std::same_as<Shape, Cone> || std::same_as<Shape, LatticeBox>;

/// A shape that sweeps take.
template <class Shape>
concept SweptShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OrientedBox> || std::same_as<Shape, ConvexHull>;

/// A body that find_contacts() takes.
template <class Shape>
concept ContactBody = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, OrientedBox> ||
    std::same_as<Shape, ConvexHull>;

}  // namespace espalier
