// Queries on two placed blobs: whether their surfaces touch, where and how deep, and how far apart they are.
//
// Each blob has a transform to the world (transform.hpp); a Blob by itself is placed at the origin. Results are in
// world space. Each query takes a WorkLimit, because nothing less than the product of the two trees' sizes bounds its
// time: set a limit for meshes that you did not make yourself.
//
// Any number of threads may query the same blobs, and no call allocates. Numerics and ranges are described at the end
// of this file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/contact.hpp>
#include <espalier/base/function_ref.hpp>
#include <espalier/status.hpp>
#include <espalier/transform.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// The number of pairs of nodes or leaves that a query may visit. It stops at the same pair on every machine.
class WorkLimit {
public:
    constexpr explicit WorkLimit(std::uint64_t visits) noexcept : visits_(visits) {}
    static constexpr WorkLimit unlimited() noexcept { return WorkLimit(~std::uint64_t{0}); }
    [[nodiscard]] constexpr std::uint64_t visits() const noexcept { return visits_; }

private:
    std::uint64_t visits_;
};

/// Two triangles that touch, one of each blob. Converts to true if there is such a pair.
struct [[nodiscard]] PairContact {
    TriangleId a;
    TriangleId b;
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, work_limit, or why the query was refused
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
    friend constexpr bool operator==(const PairContact&, const PairContact&) = default;
};

/// The nearest points of two surfaces. Converts to true if the search found them and was complete.
struct [[nodiscard]] BlobDistance {
    float distance = infinity;  ///< 0 where the surfaces touch; infinity if nothing was found
    Vec3 on_a;
    Vec3 on_b;
    TriangleId a;  ///< the triangle that contains on_a
    TriangleId b;
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, work_limit (an upper bound), or why it was refused
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns whether a triangle of a touches one of b. A surface inside another does not touch it.
///
/// With the status work_limit the answer is undecided: neither yes() nor no(), and not is_refused(). Like all queries
/// in this file, this one refuses a blob that is not open (not_open); a transform that is not finite, whose rotation
/// has length zero or whose scale is not above 0 (invalid_argument); and placements that are out of range
/// (out_of_range, see Numerics).
[[nodiscard]] YesNo overlaps(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept;

/// Returns a pair of triangles that touch. It is the first pair of for_each_contact(), except that in a blob with
/// duplicate references it may come later there. Refusals and cost are those of overlaps().
[[nodiscard]] PairContact first_contact(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept;

/// Calls `visit` with each pair of triangles that touch, until it returns Visit::stop. It may also return void.
///
/// The order follows the two trees and is the same on every machine. Each pair comes once. In a blob with duplicate
/// references (Blob::duplicate_reference_count()), a pair found through such a reference costs another traversal, of
/// the boxes that both triangles touch, which also counts toward the limit. Returns ok, stopped, work_limit (some pairs
/// are missing), or a refusal like overlaps().
QueryStatus for_each_contact(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairContact&> visit,
                             WorkLimit limit) noexcept;

/// Writes the pairs of for_each_contact() to an array, in the same order and in pages.
///
/// After output_full or work_limit, Filled::next resumes after the last pair written, for the same blobs and
/// transforms. Each page has the whole limit to itself. If a page ends with work_limit and Filled::next equals `from`,
/// the limit is too small to reach the next pair, and only a larger one makes progress. A page costs the way down both
/// trees and the work for its own pairs. A cursor of other blobs yields invalid_argument or some of the pairs. Refusals
/// are those of overlaps().
Filled collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::span<PairContact> contacts, WorkLimit limit,
                        Cursor from = {}) noexcept;

/// The largest number of points of a PairTouch.
inline constexpr std::size_t max_touch_points = 6;

/// The contact between two triangles, one of each blob. Converts to true if they touch.
struct [[nodiscard]] PairTouch {
    /// Their convex hull is what the two triangles have in common: a segment given by its ends, a polygon given by its
    /// corners if both triangles lie in one plane, or a single point. The points are in no particular order.
    Vec3 points[max_touch_points];
    Vec3 normal;         ///< unit length, from a to b: the direction in which b leaves a
    float depth = 0.0f;  ///< how far b moves along the normal until they only touch; the least of all directions
    TriangleId a;
    TriangleId b;
    std::uint8_t count = 0;  ///< number of points, 1 to 6
    QueryStatus status = QueryStatus::not_open;
    std::uint8_t reserved[2] = {};

    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }

    /// Returns one of the points as a contact of body b with the surface a, for reduce_contacts(). Its distance is
    /// minus the depth.
    [[nodiscard]] constexpr Contact contact(std::size_t number) const noexcept {
        Contact result;
        result.point = points[number < max_touch_points ? number : 0];
        result.normal = normal;
        result.distance = -depth;
        result.triangle = a;
        return result;
    }
};

/// Returns the contact between two triangles that first_contact() or collect_contacts() found for the same placements.
///
/// The status is ok; not_found if they do not touch; invalid_argument for a triangle that a blob does not have; or a
/// refusal like that of overlaps() of two blobs. Cost: O(depth), for the way down to each triangle.
PairTouch pair_touch(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair) noexcept;

/// Calls `visit` with the contact of each touching pair, in the order of for_each_contact(), until it returns
/// Visit::stop. A visitor may also return void. Status and cost are those of for_each_contact(), because the triangles
/// are at hand and need not be looked up in the trees.
QueryStatus for_each_touch(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairTouch&> visit,
                           WorkLimit limit) noexcept;

/// Writes what for_each_touch() visits to an array, in pages and with cursors like those of collect_contacts().
Filled collect_touches(const PlacedBlob& a, const PlacedBlob& b, std::span<PairTouch> touches, WorkLimit limit,
                       Cursor from = {}) noexcept;

/// Returns the smallest distance between the two surfaces, if it is within max_distance (0 or more, or infinity), and
/// where it is.
///
/// On a tie above 0 the lowest a wins, then the lowest b; where the surfaces touch, the pair is that of
/// first_contact(). not_found means that nothing is within max_distance; work_limit that the distance is only an upper
/// bound, or infinity if nothing was found yet. Refuses what overlaps() refuses, and a max_distance that is negative or
/// NaN (invalid_argument).
[[nodiscard]] BlobDistance distance(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit,
                                    float max_distance = infinity) noexcept;

/// Returns whether the surfaces are at most `distance` (0 or more, or infinity) apart. Cheaper than distance(), and
/// refuses the same arguments.
[[nodiscard]] YesNo within_distance(const PlacedBlob& a, const PlacedBlob& b, float distance, WorkLimit limit) noexcept;

}  // namespace espalier

// Numerics
//
// Both meshes are rounded once, onto one grid of integers in the local space of a. For these two meshes every decision
// is exact on every machine, as if all pairs of triangles had been tested. Touching counts.
//
// Grid. The step of the grid is a power of two times the lattice step of a: the smallest for which all coordinates,
// counted from the lattice origin of a, stay within 2^24, but no smaller than 2^-6 of the finer of the two lattice
// steps. A vertex moves by at most half a step of the grid along each axis. That is 2^-7 of a lattice step for assets
// of 16 bits and similar size, and never more than 2^-24 of the farthest coordinate. The vertices of a do not move at
// all unless the grid is coarser than their lattice. The entries of the rotation are rounded to 2^-30. Vertices that
// triangles share stay shared.
//
// Transforms. b is placed in the local space of a by to_local(a.transform(), b.transform()), whose error, described in
// transform.hpp, moves and turns b as a whole. If a is at the origin, the transform of b is used unchanged. Exchanging
// a and b may therefore change answers within these errors.
//
// Distances. They are compared by their squares, each within 8 ulp of the exact one. The distance is within 4 ulp of
// that of the rounded meshes, and each point within 16 ulp of the largest coordinate of the two placed bounds. If the
// scale of a is not 1, the distance is rounded once more, as is a distance given to a query, which is otherwise
// compared exactly. If a is not at the origin, points are moved by to_world().
//
// Touches. Which triangles touch, and in how many points, is exact. Points that are corners of a triangle are exact
// there; others are within 2^-21 of the length of a side, and in the world each coordinate adds 16 ulp of the largest
// coordinate of the two placed bounds. The depth is within 2^-20 of the longest distance from the first corner of a to
// any other corner of either triangle, and so is the depth that remains after moving b out by it. If two directions are
// equally short within this error, the normal is either of them. Triangles in one plane have a depth of 0 within this
// error, and a normal of that plane.
//
// The depth and normal separate only these two triangles. Other pairs of the same blobs may need a longer way or
// another one: reduce the contacts of all pairs with reduce_contacts(), move by what remains, and query again.
//
// Range. Queries return out_of_range, in O(1), in these cases: a corner of the bounds of b is more than 2^80 lattice
// steps of a away; a is not at the origin and one of the scales is not between 2^-100 and 2^100; or, for distances, the
// gap between the bounds along some axis is more than 1,024 times the longest side of either. In this last case, a
// max_distance less than half of the gap yields not_found instead.
//
// Work. A distance first searches for a touching pair, and then for a near one, in up to 9 times the sum of both depths
// plus 4 visits, before it searches for the nearest. All of this counts toward the limit. Blobs whose bounds are
// clearly apart, or clearly farther than the distance, take one visit and a fraction of the time. The stack is bounded
// (docs/benchmarks.md). OBB tests follow Gottschalk, Lin and Manocha (1996), triangle tests Devillers and Guigue
// (2002); docs/numerics.md has the proofs.
