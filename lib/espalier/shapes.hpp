// The shapes that queries take, in the units and axes of the baked mesh.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>

#include <espalier/types.hpp>

namespace espalier {

/// All points between two points, including both.
struct Segment {
    Vec3 from;
    Vec3 to;
};

/// All points within `radius` of the center. A radius of 0 makes it a point.
struct Sphere {
    Vec3 center;
    float radius = 0.0f;
};

/// All points within `radius` of the segment between `from` and `to`. If from == to, it is a sphere.
struct Capsule {
    Vec3 from;
    Vec3 to;
    float radius = 0.0f;
};

/// An axis-aligned box. It may be flat or a single point, and is empty if a coordinate of `min` exceeds that of `max`.
struct Box {
    Vec3 min;
    Vec3 max;
};

/// A box of any orientation. Each half axis leads from the center to the middle of a face. Half axes may be zero and
/// need not be perpendicular: a sheared box is valid.
struct OrientedBox {
    Vec3 center;
    Vec3 half_axes[3];
};

/// The convex hull of `apex` and a disc, such as a spot light or a field of view. The disc is centered at apex + axis
/// and perpendicular to the axis; its radius is length(axis) * tan(half the opening angle). A radius of 0 makes the
/// cone a segment.
///
/// Queries refuse an infinite radius and an axis shorter than 2^-17 of the grid, which is about 2^-23 lattice steps
/// (invalid_argument), and an apex 2^36 lattice steps away or an axis of that length (out_of_range).
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

/// The largest number of planes of a ConvexVolume, enough for a 26-DOP.
inline constexpr std::size_t max_planes = 32;

/// All points behind every one of the planes: a frustum or a k-DOP, for example. It may be unbounded; without planes it
/// is all of space. The planes must outlive it.
struct ConvexVolume {
    std::span<const Plane> planes;
};

/// The largest number of vertices of a ConvexHull.
inline constexpr std::size_t max_hull_vertices = 64;

/// The convex hull of a set of vertices, which sweep() and find_contacts() take. The vertices may come in any order and
/// may be repeated, lie inside the hull, in one plane or on one line. Without vertices the hull is empty. The vertices
/// must outlive it.
struct ConvexHull {
    std::span<const Vec3> vertices;
};

struct LatticeBox;  // defined in advanced/lattice.hpp

/// The shapes that overlaps(), for_each_overlap() and collect_overlaps() take. Triangle is defined in types.hpp.
template <class Shape>
concept OverlapShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OrientedBox> || std::same_as<Shape, Triangle> || std::same_as<Shape, ConvexVolume> ||
    std::same_as<Shape, Cone> || std::same_as<Shape, LatticeBox>;

/// The shapes that sweep() takes.
template <class Shape>
concept SweptShape = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, Box> ||
    std::same_as<Shape, OrientedBox> || std::same_as<Shape, ConvexHull>;

/// The bodies that find_contacts() takes.
template <class Shape>
concept ContactBody = std::same_as<Shape, Sphere> || std::same_as<Shape, Capsule> || std::same_as<Shape, OrientedBox> ||
    std::same_as<Shape, ConvexHull>;

}  // namespace espalier
