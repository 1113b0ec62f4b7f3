// The contact of a moving shape with a triangle, in lattice units, and what the caller receives of it.
#pragma once

#include <espalier/sweep.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/lattice/to_local.hpp>
#include <runtime/sweeps/round_sweep.hpp>
#include <runtime/sweeps/separating_directions.hpp>

namespace espalier::detail {

struct FoundContact : Found {
    SweepTick tick = no_contact;
    LatticeTriangle triangle;
    float gap = 0.0f;  ///< of a contact at the start: the smaller, the deeper

    [[nodiscard]] float key() const { return share_of_way(tick); }
    [[nodiscard]] float limit(float) const { return key(); }
};
/// Whether a is earlier than b, or deeper at the start, or as early and as deep and of a lower index.
inline bool comes_before(const FoundContact& a, const FoundContact& b) {
    if (a.tick != b.tick) return a.tick < b.tick;
    return a.gap < b.gap || (a.gap == b.gap && a.index < b.index);
}

// What the queries and their loop over all triangles share: the contact of each shape with one triangle.

/// Out of line: what it needs must not lie on the stack below the kernel of the start.
ESPALIER_NOINLINE inline SweepTick first_contact_after_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle,
                                                             SweepTick most) noexcept {
    return first_contact_tick(sweep.moving, sweep.seen_from(sweep.from, triangle), most);
}
inline SweepTick first_contact_tick(const CapsuleSweep& sweep, const LatticeTriangle& triangle,
                                    SweepTick most) noexcept {
    if (takes_shortcut(is_zero(sweep.moving.axis)))  // a sphere's kernel looks at the start by itself
        return first_contact_tick(sweep.moving.sphere, sweep.seen_from(sweep.from, triangle), most);
    return touches_at_start(sweep, triangle) ? 0 : first_contact_after_start(sweep, triangle, most);
}
inline SweepTick first_contact_tick(const BoxSweep& sweep, const LatticeTriangle& triangle, SweepTick most) noexcept {
    return first_contact_tick(sweep, integer_triangle(triangle, sweep.fraction_bits), most);
}
inline SweepTick first_contact_tick(const HullSweep& sweep, const LatticeTriangle& triangle, SweepTick most,
                                    PlaneAhead& plane) noexcept {
    return first_contact_tick(sweep.moving, integer_triangle(triangle, sweep.fraction_bits), most, plane);
}
inline SweepTick first_contact_tick(const HullSweep& sweep, const LatticeTriangle& triangle, SweepTick most) noexcept {
    PlaneAhead plane;
    return first_contact_tick(sweep, triangle, most, plane);
}

inline SweepContact contact_at(const CapsuleSweep& sweep, const LatticeTriangle& triangle, SweepTick tick) noexcept {
    return contact_at(sweep.moving, sweep.seen_from(sweep.from, triangle), tick);
}
inline SweepContact contact_at(const BoxSweep& sweep, const LatticeTriangle& triangle, SweepTick tick) noexcept {
    return contact_at(sweep, integer_triangle(triangle, sweep.fraction_bits), tick);
}
inline SweepContact contact_at(const HullSweep& sweep, const LatticeTriangle& triangle, SweepTick tick) noexcept {
    return contact_at(sweep.moving, integer_triangle(triangle, sweep.fraction_bits), tick);
}
/// Where a shape touches at the start: as seen from its middle.
inline SweepContact contact_at_start(const LatticeSweep& sweep, const LatticeTriangle& triangle) noexcept {
    return contact_at(MovingSphere{sweep.displacement, 0}, sweep.seen_from(sweep.middle(), triangle), 0);
}

// How deep a shape is in a triangle that it touches at the start: the smaller the number, the deeper.

/// The squared distance from the axis, or less than 0 where the two touch.
float gap_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle);
float gap_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle);
float gap_at_start(const HullSweep& sweep, const LatticeTriangle& triangle);

// Whether the way leads a shape no deeper into a triangle that it touches at the start. It then gets no deeper until
// the end of the way: a distance is convex along it, and a depth concave (docs/numerics.md, Sweeps).

/// Exactly. False where the axis touches the triangle.
bool leaves_at_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle);
// Along the shortest way out.
bool leaves_at_start(const BoxSweep& sweep, const LatticeTriangle& triangle);
bool leaves_at_start(const HullSweep& sweep, const LatticeTriangle& triangle);

/// Whether the way leads along the normal of a face that is culled, or against it, exactly.
ESPALIER_SHARED_CODE inline bool is_culled(const LatticeSweep& sweep, const LatticeTriangle& triangle,
                                           FaceCulling culling) {
    const int along = sign(dot<Int128>(normal_of(integer_triangle(triangle)), sweep.displacement));
    return culling == FaceCulling::back ? along > 0 : culling == FaceCulling::front && along < 0;
}
/// Whether the options leave out a triangle that the shape first touches at that tick, apart from the filter.
template <class Sweep>
bool is_left_out(const Sweep& sweep, const LatticeTriangle& triangle, SweepTick tick, const SweepOptions& options) {
    if (options.culling != FaceCulling::none && is_culled(sweep, triangle, options.culling)) return true;
    return tick == 0 && options.ignore_leaving && leaves_at_start(sweep, triangle);
}
template <class Sweep>
FoundContact found_contact(const Sweep& sweep, const LatticeTriangle& triangle, std::uint32_t index, SweepTick tick) {
    return {{index}, tick, triangle, tick == 0 ? gap_at_start(sweep, triangle) : 0.0f};
}

/// Returns the last tick before a contact at which the shape is no nearer than the skin, in lattice steps, to the plane
/// of the contact; the start if it is nearer there.
ESPALIER_SHARED_CODE inline std::uint32_t tick_at_skin(const LatticeSweep& sweep, SweepTick first, const Vec3& normal,
                                                       float skin) {
    const std::uint32_t tick = tick_before(first);
    if (!(skin > 0.0f) || tick == 0) return tick;
    const float scale = power_of_two(-sweep.fraction_bits);
    const Vec3 way = to_vector(sweep.displacement) * scale;
    // The normal is within 4 ulp, so the shape is at least as fast as this.
    const float error = sum_of_magnitudes(way) * 0x1p-20f;
    const float speed = -dot(way, normal) - error;
    const float ticks = skin / speed * (0x1p24f * (1.0f + 0x1p-20f)) + 1.0f;
    if (!(speed > 0.0f) || !(ticks < static_cast<float>(tick))) return 0;
    return tick - static_cast<std::uint32_t>(ticks);
}

/// Builds the result for the caller. The shape stops at a distance of `skin`, in lattice steps, before the contact.
template <class Sweep>
SweepHit to_sweep_hit(const BlobData& blob, const Sweep& sweep, const FoundContact& found, float skin = 0.0f) noexcept {
    const bool at_start = found.tick == 0;
    const SweepContact contact =
        at_start ? contact_at_start(sweep, found.triangle) : contact_at(sweep, found.triangle, found.tick);
    const Vec3 point = point_of(found.triangle, contact.u, contact.v);
    SweepHit hit;
    hit.t = share_of_way(tick_at_skin(sweep, found.tick, contact.normal, skin));
    hit.point = to_local(blob, point.x, point.y, point.z);
    hit.normal = contact.normal;
    hit.face_normal = face_normal_of(found.triangle);
    hit.triangle = TriangleId{found.index};
    hit.status = QueryStatus::ok;
    hit.feature = contact.feature;
    hit.starts_overlapping = at_start;
    return hit;
}

}  // namespace espalier::detail
