// Queries in whole lattice steps, without floats: for cores without a floating-point unit, and for positions that are
// already counted in steps.
//
// A coordinate in the blob's units is origin + steps * 2^step_exponent, and the triangles extend from 0 to `extent`
// steps along each axis. Queries refuse a blob that is not open (not_open). Any number of threads may query the same
// blob, and no call allocates. Numerics are described at the end of this file.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/overlap.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// A point of a lattice, in whole steps.
struct LatticePoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
    std::int32_t z = 0;
    friend constexpr bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

/// An axis-aligned box. It may be flat or a single point, and is empty if a coordinate of `min` exceeds that of `max`.
struct LatticeBox {
    LatticePoint min;
    LatticePoint max;
};

/// All points between two lattice points, including both.
struct LatticeSegment {
    LatticePoint from;
    LatticePoint to;
};

/// The largest magnitude of a segment's coordinates and of those that to_lattice() returns.
inline constexpr std::int32_t max_lattice_coordinate = 1 << 29;

/// Returns the lattice point nearest to a point in the blob's local space, or the upper one of two that are equally
/// near.
///
/// Refuses a point or lattice with a NaN or an infinity and a step_exponent outside -100 .. 100 (invalid_argument), and
/// a result beyond max_lattice_coordinate (out_of_range). Subnormal coordinates count as zero. The result is exact on
/// every core, and no float operation is executed.
Result<LatticePoint> to_lattice(const Lattice& lattice, const Vec3& local) noexcept;
/// Returns the smallest box in whole steps that contains a box in local space. Refuses what the overload for a point
/// does.
Result<LatticeBox> to_lattice(const Lattice& lattice, const Box& local) noexcept;
/// Returns the position of a lattice point in the blob's local space. Each coordinate is within 2 roundings to float.
/// Executes float operations.
[[nodiscard]] Vec3 to_local(const Lattice& lattice, const LatticePoint& steps) noexcept;

// overlaps(), for_each_overlap() and collect_overlaps() in overlap.hpp also take a LatticeBox.

/// Where a segment hits a triangle. Converts to true if there is a hit; after a miss or a refusal, t has its largest
/// value and the triangle is no_triangle.
struct [[nodiscard]] LatticeHit {
    std::uint32_t t = 0xFFFFFFFFu;  ///< the point is from + (to - from) * t / 2^31, rounded down; 2^31 is the end
    TriangleId triangle;
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, or why the segment was refused
    Side side = Side::front;                     ///< the side that was hit
    std::uint8_t reserved[2] = {};

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

namespace detail {

LatticeHit raycast_lattice(const Blob& blob, const LatticeSegment& segment) noexcept;
YesNo occluded_lattice(const Blob& blob, const LatticeSegment& segment) noexcept;

}  // namespace detail

/// Returns the hit with the smallest t. Hits are compared by their exact t, not the rounded one, and on a tie the
/// lowest triangle wins.
///
/// Refuses, in O(1), an end with a coordinate beyond max_lattice_coordinate (out_of_range) and a segment of length zero
/// (invalid_argument). Expected cost: O(log n); for the worst case see docs/queries/README.md, Bounded.
template <std::same_as<LatticeSegment> Segment>  // a template, so that two vectors in braces mean a Ray
LatticeHit raycast(const Blob& blob, const Segment& segment) noexcept {
    return detail::raycast_lattice(blob, segment);
}

/// Returns whether the segment hits any triangle, in less time than raycast(). Refuses the same segments.
template <std::same_as<LatticeSegment> Segment>
YesNo occluded(const Blob& blob, const Segment& segment) noexcept {
    return detail::occluded_lattice(blob, segment);
}

}  // namespace espalier

// Numerics
//
// Nothing is rounded. Whether a triangle touches the box, whether the segment hits it, on which side, and which hit
// comes first: all are decided exactly for the numbers given. Touching counts. A segment that lies in the plane of a
// triangle does not hit it. Boxes may have any coordinates.
