// The lattice of a blob, and queries whose arguments are whole lattice steps: for cores without floats, which link none
// for them. Whoever knows at build time where things are asks in steps right away; what moves counts in steps itself.
//
// Steps. A world coordinate is origin + steps * 2^step_exponent. The asset reaches from 0 to `extent` along each axis.
//
// Numbers. Nothing is rounded: whether a triangle touches the box, whether the segment hits it and which hit comes
// first are decided exactly, on the numbers given. Touching counts. A segment inside the plane of a triangle does not
// hit that triangle, and a segment of length zero hits nothing: as of rays (ray.hpp).
//
// Arguments. A box may be any numbers; with min above max along an axis it is empty and overlaps nothing. The ends of a
// segment must be within max_segment_steps along each axis, else the answer is out_of_range, O(1).
#pragma once

#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

struct Lattice {
    Vec3 origin;
    std::int32_t step_exponent = 0;
    std::int32_t extent[3] = {};
};

/// Returns the lattice of a blob. That of a blob without triangles describes nothing, and its step may be any.
[[nodiscard]] Lattice lattice_of(const Blob& blob) noexcept;

/// A point of the lattice.
struct Steps {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    friend constexpr bool operator==(const Steps&, const Steps&) = default;
};

/// As Box.
struct BoxInSteps {
    Steps min;
    Steps max;
};

/// As Segment.
struct SegmentInSteps {
    Steps from;
    Steps to;
};

inline constexpr std::int32_t max_segment_steps = 1 << 29;

// From the world to the lattice and back. They take floats, but no float operation: exactly rounded on every core.
// invalid_argument for a NaN or an infinity, also in the lattice, and for a step_exponent beyond -100 .. 100, which no
// blob has; out_of_range for what is beyond max_segment_steps. Then nothing is written. Subnormal coordinates count as
// zero.

/// The nearest lattice point, of two the upper one.
QueryStatus to_steps(const Lattice& lattice, const Vec3& world, Steps& steps) noexcept;
/// The smallest box in whole steps that holds the world's box.
QueryStatus steps_around(const Lattice& lattice, const Box& world, BoxInSteps& box) noexcept;
/// Where a lattice point is, each coordinate within 2 roundings to float. Needs float operations.
[[nodiscard]] Vec3 to_world(const Lattice& lattice, const Steps& steps) noexcept;

/// The three ways of asking about a box, as in overlap.hpp.
[[nodiscard]] bool overlaps(const Blob& blob, const BoxInSteps& box) noexcept;
bool for_each_overlap(const Blob& blob, const BoxInSteps& box, FunctionRef<Visit(Triangle)> visit);
OverlapPage collect_overlaps(const Blob& blob, const BoxInSteps& box, std::span<Triangle> out,
                             std::uint32_t first = 0) noexcept;

struct HitInSteps {
    /// Where on the segment: from + (to - from) * t / 2^31, rounded down; 2^31 at its end.
    std::uint32_t t = 0;
    /// front or back: the side from which the segment meets the triangle.
    Faces side = Faces::front;
    Triangle triangle = no_triangle;
};

/// The first hit along the segment: the one with the smallest t, compared exactly and not as rounded, of equal ones
/// that with the lowest storage index. hit.triangle is no_triangle where nothing is hit. ok or out_of_range; `hit` is
/// untouched unless ok.
QueryStatus first_hit(const Blob& blob, const SegmentInSteps& segment, HitInSteps& hit) noexcept;

/// Whether the segment hits anything. Cheaper than the first hit. `hit` is untouched unless ok.
QueryStatus any_hit(const Blob& blob, const SegmentInSteps& segment, bool& hit) noexcept;

}  // namespace espalier
