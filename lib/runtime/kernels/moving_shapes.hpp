// Shapes that move along a line against a triangle: the kernels of sweeps. The distance of a moving point from a
// triangle is a convex function of time, and whether it is above, at or below the radius is decided in integers at
// every tick. So the first tick with contact of a sphere is found by advancing along tangents, which never overshoot,
// and closing in: the conservative advancement of Mirtich (1996), with exact decisions.
#pragma once

#include <cstdint>

#include <espalier/shapes.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

// When a moving shape first touches something, counted in ticks: 2^24 of them are the whole way.

/// The first tick at which the shape touches, or has touched: 0 when it does so at the start already.
using SweepTick = std::uint32_t;

inline constexpr int tick_bits = 24;
inline constexpr SweepTick whole_way = SweepTick{1} << tick_bits;
inline constexpr SweepTick no_contact = 0xFFFFFFFFu;

/// Returns a number of ticks as a share of the way, exactly.
inline float share_of_way(std::uint32_t ticks) { return static_cast<float>(ticks) * power_of_two(-tick_bits); }
/// The first tick at or after a share of the way, which is that quotient.
inline SweepTick first_tick_from(const Int128& numerator, const Int128& denominator) {
    const Int128 whole = numerator << tick_bits;
    const auto is_reached = [&](std::int64_t tick) { return !(multiply(denominator, tick) < whole); };
    auto ticks = to_integer(to_float(numerator) / to_float(denominator) * 0x1p24f);
    while (is_reached(ticks - 1)) --ticks;
    while (!is_reached(ticks)) ++ticks;
    return static_cast<SweepTick>(ticks);
}
/// The last tick before the first contact; the start when it touches there.
constexpr std::uint32_t tick_before(SweepTick tick) { return tick == 0 ? 0 : tick - 1; }

/// Where a moving shape touches a triangle.
struct SweepContact : Weights {
    Vec3 normal;      ///< unit, from the triangle towards the shape
    Feature feature;  ///< the part of the triangle that holds the point
};

/// Starts at 0: triangles are seen from its centre's start. Coordinates of triangles and displacement stay below 2^35,
/// the radius below 2^35, sides of triangles below 2^26, all in the same units (docs/numerics.md).
struct MovingSphere {
    Integer3 displacement;
    std::int64_t radius;
};

/// The first tick at which the sphere touches the triangle, also one without area; no_contact when it does not, or
/// later than at tick `most`. The search begins at `least`, which should be before the contact: any value is safe.
SweepTick first_contact_tick(const MovingSphere& sphere, const IntegerTriangle& triangle, SweepTick most,
                             SweepTick least = 0) noexcept;

/// The point of the triangle that is closest to the sphere's centre at that tick, and the direction from there to the
/// centre; where the centre lies on the triangle, the triangle's normal that looks against the displacement.
SweepContact contact_at(const MovingSphere& sphere, const IntegerTriangle& triangle, std::uint32_t tick) noexcept;

/// Returns whether no part of a convex body, the hull of the points, is nearer to the sphere's centre at a tick than
/// the face is. The centre is outside of the body then.
bool is_nearest_face(const MovingSphere& sphere, const IntegerTriangle& face, const Integer3* points, unsigned count,
                     std::uint32_t tick) noexcept;

/// How a point that begins to move is to a face of a convex body.
enum class Departure : std::uint8_t {
    touches,
    is_elsewhere,  ///< another face is nearer to the point
    closes,
    leaves,  ///< gets no nearer
};
/// Returns it for the start of the sphere's centre, of a body that is the hull of the points.
Departure departure_from(const MovingSphere& sphere, const IntegerTriangle& face, const Integer3* points,
                         unsigned count) noexcept;

/// A capsule. Seen from the sphere at the start of its axis, the triangle is swept along the axis backwards: a prism,
/// whose faces the sphere meets or does not. Triangles are seen from the start of the axis at the start of the way. The
/// axis stays below 2^25, the rest is bounded as in MovingSphere.
struct MovingCapsule {
    MovingSphere sphere;  ///< around the start of the axis
    Integer3 axis;
};

/// Like that of a sphere, for a capsule that does not touch at the start.
SweepTick first_contact_tick(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepTick most) noexcept;

/// Returns whether the axis does not touch the triangle at the start, and does not come nearer from there on.
bool leaves_at_start(const MovingCapsule& capsule, const IntegerTriangle& triangle) noexcept;

/// Returns one of the eight faces of the prism.
IntegerTriangle face_of_prism(const MovingCapsule& capsule, const IntegerTriangle& triangle, unsigned face);
/// The faces of the prism: a corner is one of the triangle's, and 4 more where it is moved back by the axis.
inline constexpr std::uint8_t faces_of_prism[8][3] = {{0, 1, 2}, {4, 6, 5}, {0, 5, 1}, {0, 4, 5},
                                                      {1, 6, 2}, {1, 5, 6}, {2, 4, 0}, {2, 6, 4}};

/// For a first contact at that tick: the point of the triangle that is closest to the axis at the tick
/// before, and the direction from there to the closest point of the axis.
SweepContact contact_at(const MovingCapsule& capsule, const IntegerTriangle& triangle, SweepTick tick) noexcept;

/// An axis-aligned box, low <= high. The kernel tries separating axes, each with the time at which it stops to separate
/// and that at which it begins again (Eberly 2001), as quotients of integers. Coordinates stay below 2^35, those of
/// triangles below 2^25, their sides too.
struct MovingBox {
    Integer3 low;
    Integer3 high;
    Integer3 displacement;
};

/// The first tick at which the box touches the triangle, also one without area; no_contact when it does not, or later
/// than at tick `most`.
SweepTick first_contact_tick(const MovingBox& box, const IntegerTriangle& triangle, SweepTick most) noexcept;

/// For a first contact at that tick, which is not 0: the middle of what of the triangle lies in the box at the tick
/// before, grown by what it moves in a tick and by roundings; and the axis that is the last to separate, of several the
/// first in the order x, y, z, the triangle's normal, then products of sides and axes. The feature is what of the
/// triangle is nearest along that axis, exactly.
SweepContact contact_at(const MovingBox& box, const IntegerTriangle& triangle, SweepTick tick) noexcept;

/// A convex hull of points: the shape of oriented boxes and convex hulls that move. Where hull and triangle touch, the
/// way from a point of the hull to a point of the triangle is the part of the displacement that is done: the line of
/// the displacement meets the convex hull of all those differences. The kernel finds where it does so first, by the
/// simplex method (Dantzig 1951): three differences that surround the line are exchanged one by one (docs/numerics.md,
/// Sweeps).
///
/// Coordinates of displacement and differences stay below 2^30 + 4. Not empty. Points may be repeated, and may lie in
/// one plane, on one line or in the hull of the others.
struct MovingHull {
    Integer3 displacement;
    unsigned point_count;
    std::int32_t point[max_hull_vertices][3];
};

/// A plane behind which a hull stays for a part of its way. One that separated it from a triangle often separates it
/// from the neighbours too.
struct PlaneAhead {
    Integer3 normal{};
    Int128 hull_end = 0;  ///< how far the hull reaches along the normal at the start
    Int128 speed = 0;     ///< how far it moves along the normal on the whole way; 0 where there is no plane yet
};

/// The first tick at which the hull touches the triangle, also one without area; no_contact when it does not, or later
/// than at tick `most`. Uses the plane that a call for another triangle left, and leaves one: it changes no answer.
SweepTick first_contact_tick(const MovingHull& hull, const IntegerTriangle& triangle, SweepTick most,
                             PlaneAhead& plane) noexcept;
inline SweepTick first_contact_tick(const MovingHull& hull, const IntegerTriangle& triangle, SweepTick most) noexcept {
    PlaneAhead plane;
    return first_contact_tick(hull, triangle, most, plane);
}

/// For a first contact at that tick, which is not 0: a point of the triangle that the hull touches then, and the normal
/// of a plane that separates the two until then: the triangle's, if that does. The feature is the smallest part of the
/// triangle with the exact point.
SweepContact contact_at(const MovingHull& hull, const IntegerTriangle& triangle, SweepTick tick) noexcept;

}  // namespace espalier::detail
