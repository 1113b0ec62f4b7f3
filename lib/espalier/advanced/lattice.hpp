// Queries in whole lattice steps, without floats: for cores without a floating-point unit, and for positions that are
// counted in steps anyway.
//
// A coordinate in the blob's units is origin + steps * 2^step_exponent; the triangles reach from 0 to `extent` along
// each axis. Queries refuse a blob that is not open with not_open. Thread safety: any number of threads may query one
// blob. No call allocates. Numerics are described at the end of this file.
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

/// An axis-aligned box. Empty if a coordinate of `min` is above that of `max`; flat ones and points are boxes too.
struct LatticeBox {
    LatticePoint min;
    LatticePoint max;
};

/// The points between two lattice points, both included.
struct LatticeSegment {
    LatticePoint from;
    LatticePoint to;
};

/// The largest magnitude of a coordinate of a segment, and of what to_lattice() returns.
inline constexpr std::int32_t max_lattice_coordinate = 1 << 29;

/// Returns the lattice point nearest to a point in the blob's local space; of two, the upper one.
///
/// Refuses a NaN or an infinity, also in the lattice, and a step_exponent outside of -100 .. 100 (invalid_argument),
/// and a result beyond max_lattice_coordinate (out_of_range). Subnormal coordinates count as zero. Exact on every core,
/// without a float operation.
Result<LatticePoint> to_lattice(const Lattice& lattice, const Vec3& local) noexcept;
/// Returns the smallest box in whole steps that holds a box in local space. Refuses as for a point.
Result<LatticeBox> to_lattice(const Lattice& lattice, const Box& local) noexcept;
/// Returns the place of a lattice point in the blob's local space, each coordinate within 2 roundings to float. Needs
/// float operations.
[[nodiscard]] Vec3 to_local(const Lattice& lattice, const LatticePoint& steps) noexcept;

// overlaps(), for_each_overlap() and collect_overlaps() take a LatticeBox (overlap.hpp).

/// The place where a segment hits a triangle. Converts to true if it does. A miss or a refusal has the largest t and
/// no_triangle.
struct [[nodiscard]] LatticeHit {
    std::uint32_t t = 0xFFFFFFFFu;  ///< the point is from + (to - from) * t / 2^31, rounded down; 2^31 at the end
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

/// Returns the hit with the smallest t, compared exactly and not as rounded; of equal ones that with the lowest
/// triangle.
///
/// Refuses an end beyond max_lattice_coordinate along an axis (out_of_range) and a segment of length zero
/// (invalid_argument), both in O(1). Cost: expected O(log n); docs/queries/README.md, Bounded, has the bound.
template <std::same_as<LatticeSegment> Segment>  // a template, so that two vectors in braces are a Ray
LatticeHit raycast(const Blob& blob, const Segment& segment) noexcept {
    return detail::raycast_lattice(blob, segment);
}

/// Returns whether the segment hits any triangle. Takes less time than raycast(), and refuses the same segments.
template <std::same_as<LatticeSegment> Segment>
YesNo occluded(const Blob& blob, const Segment& segment) noexcept {
    return detail::occluded_lattice(blob, segment);
}

}  // namespace espalier

// Numerics
//
// Nothing is rounded: whether a triangle touches the box, whether the segment hits it and on which side, and which hit
// comes first are decided exactly, on the numbers given. Touching counts. A segment within the plane of a triangle does
// not hit it. Boxes may have any coordinates.
