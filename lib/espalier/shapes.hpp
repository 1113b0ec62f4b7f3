// The shapes that queries ask with, in the units and axes that the asset was baked in.
#pragma once

#include <espalier/types.hpp>

namespace espalier {

struct Segment {
    Vec3 from;
    Vec3 to;
};

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

/// A box of any orientation: each half axis leads from the center to the middle of a face. They need not be
/// perpendicular, so that a sheared box is as good, and may be zero.
struct OrientedBox {
    Vec3 center;
    Vec3 half_axes[3];
};

/// The half-space dot(normal, x) <= offset. The normal, which points outward, may have any length but zero.
struct Plane {
    Vec3 normal;
    float offset = 0.0f;
};

}  // namespace espalier
