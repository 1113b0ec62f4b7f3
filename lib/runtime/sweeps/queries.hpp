// The first triangle that a moving shape touches, in lattice units, once for each instruction set.
#pragma once

#include <espalier/sweep.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/kernels/face.hpp>
#include <runtime/lanes/select.hpp>
#include <runtime/lattice/to_world.hpp>
#include <runtime/sweeps/round_sweep.hpp>
#include <runtime/sweeps/separating_directions.hpp>

#define ESPALIER_DECLARE_SWEEPS(instruction_set)                                                               \
    namespace instruction_set {                                                                                \
    FoundContact first_contact(const BlobData& blob, const CapsuleSweep& sweep, const TriangleFilter* filter); \
    FoundContact first_contact(const BlobData& blob, const BoxSweep& sweep, const TriangleFilter* filter);     \
    FoundContact first_contact(const BlobData& blob, const HullSweep& sweep, const TriangleFilter* filter);    \
    }

namespace espalier::detail {

struct FoundContact : Found {
    SweepStep step = no_contact;
    LatticeTriangle triangle;

    [[nodiscard]] float key() const { return share_of_way(step); }
    [[nodiscard]] float limit(float) const { return key(); }
};

// first_contact: the smallest step, of equal ones the lowest index; no_contact when there is none. The blob is not
// empty.
ESPALIER_FOR_ALL_SETS(ESPALIER_DECLARE_SWEEPS)

// What the queries and their loop over all triangles share: the contact of each shape with one triangle.

/// Out of line: what it needs must not lie on the stack below the kernel of the start.
[[gnu::noinline]] inline SweepStep first_contact_after_start(const CapsuleSweep& sweep, const LatticeTriangle& triangle,
                                                             SweepStep most) noexcept {
    return first_contact(sweep.moving, sweep.seen_from(sweep.from, triangle), most);
}
inline SweepStep first_contact(const CapsuleSweep& sweep, const LatticeTriangle& triangle, SweepStep most) noexcept {
    if (takes_shortcut(is_zero(sweep.moving.axis)))  // a sphere's kernel looks at the start by itself
        return first_contact(sweep.moving.sphere, sweep.seen_from(sweep.from, triangle), most);
    return touches_at_start(sweep, triangle) ? 0 : first_contact_after_start(sweep, triangle, most);
}
inline SweepStep first_contact(const BoxSweep& sweep, const LatticeTriangle& triangle, SweepStep most) noexcept {
    return first_contact(sweep, integer_triangle(triangle, sweep.fraction_bits), most);
}
inline SweepStep first_contact(const HullSweep& sweep, const LatticeTriangle& triangle, SweepStep most,
                               PlaneAhead& plane) noexcept {
    return first_contact(sweep.moving, integer_triangle(triangle, sweep.fraction_bits), most, plane);
}
inline SweepStep first_contact(const HullSweep& sweep, const LatticeTriangle& triangle, SweepStep most) noexcept {
    PlaneAhead plane;
    return first_contact(sweep, triangle, most, plane);
}

inline SweepContact contact_at(const CapsuleSweep& sweep, const LatticeTriangle& triangle, SweepStep step) noexcept {
    return contact_at(sweep.moving, sweep.seen_from(sweep.from, triangle), step);
}
inline SweepContact contact_at(const BoxSweep& sweep, const LatticeTriangle& triangle, SweepStep step) noexcept {
    return contact_at(sweep, integer_triangle(triangle, sweep.fraction_bits), step);
}
inline SweepContact contact_at(const HullSweep& sweep, const LatticeTriangle& triangle, SweepStep step) noexcept {
    return contact_at(sweep.moving, integer_triangle(triangle, sweep.fraction_bits), step);
}
/// Where a shape touches at the start: as seen from its middle.
inline SweepContact contact_at_start(const LatticeSweep& sweep, const LatticeTriangle& triangle) noexcept {
    return contact_at(MovingSphere{sweep.displacement, 0}, sweep.seen_from(sweep.middle(), triangle), 0);
}

/// Returns a contact as the caller receives it.
template <class Sweep>
SweepHit to_sweep_hit(const BlobData& blob, const Sweep& sweep, const FoundContact& found) noexcept {
    const bool at_start = found.step == 0;
    const SweepContact contact =
        at_start ? contact_at_start(sweep, found.triangle) : contact_at(sweep, found.triangle, found.step);
    float point[3];
    point_of(found.triangle, contact.u, contact.v, point);
    SweepHit hit;
    hit.t = share_of_way(tick_before(found.step));
    hit.point = to_world(blob, point[0], point[1], point[2]);
    hit.normal = contact.normal;
    hit.face_normal = face_normal_of(found.triangle);
    hit.triangle = TriangleId{found.index};
    hit.status = QueryStatus::ok;
    hit.starts_overlapping = at_start;
    return hit;
}

}  // namespace espalier::detail

#undef ESPALIER_DECLARE_SWEEPS
