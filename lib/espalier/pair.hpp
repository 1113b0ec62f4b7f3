// Queries of two placed blobs: whether their surfaces touch, where and how deep, and how far apart
// they are.
//
// Each blob has a place in the world (transform.hpp); a Blob alone is at the origin. Results are in world space. Each
// query takes a WorkLimit, because only the product of the two trees' sizes bounds its time: give a limit for meshes
// that you did not make yourself.
//
// Thread safety: any number of threads may query the same blobs. No call allocates. Numerics and ranges are described
// at the end of this file.
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

/// The number of pairs of nodes or leaves that a query may visit. A query stops at the same pair on every machine.
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
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, work_limit or why it was refused
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
    friend constexpr bool operator==(const PairContact&, const PairContact&) = default;
};

/// The nearest points of two surfaces. Converts to true if the search found them and came to its end.
struct [[nodiscard]] BlobDistance {
    float distance = infinity;  ///< 0 where the surfaces touch; infinity if nothing was found
    Vec3 on_a;
    Vec3 on_b;
    TriangleId a;  ///< the triangle of on_a
    TriangleId b;
    QueryStatus status = QueryStatus::not_open;  ///< ok, not_found, work_limit (an upper bound) or why it was refused
    explicit constexpr operator bool() const noexcept { return status == QueryStatus::ok; }
};

/// Returns whether a triangle of a touches one of b. A surface inside another one does not touch it.
///
/// Refuses, as all queries of this file do, a blob that is not open (not_open); a transform that is not finite or has a
/// rotation of length zero or a scale that is not above 0 (invalid_argument); and placements out of range
/// (out_of_range, see Numerics). work_limit: neither yes nor no, and not refused.
[[nodiscard]] YesNo overlaps(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept;

/// Returns a pair of triangles that touch: the first of for_each_contact(), though in a blob with duplicate references
/// it may come later there. Refusals and cost as overlaps().
[[nodiscard]] PairContact first_contact(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit) noexcept;

/// Calls `visit` with each pair of triangles that touch, until it returns Visit::stop. It returns void or Visit.
///
/// The order follows the two trees and is the same on every machine. Each pair comes once. In a blob with duplicate
/// references (Blob::duplicate_reference_count()) a pair that is met by one of them costs another walk, through the
/// boxes that both triangles touch, which the limit counts too. Returns ok, stopped, work_limit (some pairs are
/// missing) or a refusal as overlaps().
QueryStatus for_each_contact(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairContact&> visit,
                             WorkLimit limit) noexcept;

/// Writes the pairs of for_each_contact() to an array, in the same order, in pages.
///
/// After output_full or work_limit, Filled::next resumes behind the last pair that was written, for the same blobs and
/// transforms; the limit counts anew in each page. If a page ends with work_limit and Filled::next equals `from`, the
/// limit is too small to reach the next pair: only a larger one makes progress. A page costs the way down both trees
/// and the work of its own pairs. With a cursor of other blobs it returns invalid_argument or some of the pairs.
/// Refusals as overlaps().
Filled collect_contacts(const PlacedBlob& a, const PlacedBlob& b, std::span<PairContact> contacts, WorkLimit limit,
                        Cursor from = {}) noexcept;

/// The largest number of points of a PairTouch.
inline constexpr std::size_t max_touch_points = 6;

/// Where two triangles touch, one of each blob. Converts to true if they do.
struct [[nodiscard]] PairTouch {
    /// What the triangles have in common is the hull of these: the ends of a segment, the corners of a polygon where
    /// both lie in one plane, or a single point. They come in no order.
    Vec3 points[max_touch_points];
    Vec3 normal;         ///< unit length, from a to b: along it b leaves a
    float depth = 0.0f;  ///< how far b has to go along it until the two triangles only touch; the least of all ways
    TriangleId a;
    TriangleId b;
    std::uint8_t count = 0;  ///< of the points: 1 to 6
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

/// Returns where the two triangles of a pair touch, which first_contact() or collect_contacts() have found for the same
/// placements.
///
/// Status: ok; not_found if they do not touch; invalid_argument for a triangle that a blob does not have; or a refusal
/// as of overlaps() of two blobs. Cost: O(depth), the way down to each triangle.
PairTouch pair_touch(const PlacedBlob& a, const PlacedBlob& b, const PairContact& pair) noexcept;

/// Calls `visit` with the contact of each touching pair, in the order of for_each_contact(), until it returns
/// Visit::stop; a visitor may also return void. Status and cost are those of for_each_contact(): the triangles are at
/// hand, so no pair takes a way down the trees.
QueryStatus for_each_touch(const PlacedBlob& a, const PlacedBlob& b, Visitor<const PairTouch&> visit,
                           WorkLimit limit) noexcept;

/// Writes what for_each_touch() visits to an array, in pages as collect_contacts() does: with the same cursors.
Filled collect_touches(const PlacedBlob& a, const PlacedBlob& b, std::span<PairTouch> touches, WorkLimit limit,
                       Cursor from = {}) noexcept;

/// Returns the smallest distance of the two surfaces within max_distance (0 or more, or infinity), and where it is.
///
/// On a tie above 0 the lowest a wins, then the lowest b. Where the surfaces touch, the pair is that of
/// first_contact(). not_found: nothing is within max_distance. work_limit: the distance is an upper bound, infinity if
/// nothing was found yet. Refusals as overlaps(); invalid_argument also for a max_distance that is negative or NaN.
[[nodiscard]] BlobDistance distance(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit,
                                    float max_distance = infinity) noexcept;

/// Returns whether the surfaces are within `distance` (0 or more, or infinity) of each other; equal counts.
/// Cheaper than distance(). Refusals as distance().
[[nodiscard]] YesNo within_distance(const PlacedBlob& a, const PlacedBlob& b, float distance, WorkLimit limit) noexcept;

}  // namespace espalier

// Numerics
//
// Both meshes are rounded once onto one grid of integers, in the local space of a. Every decision is exact for these
// two meshes, on every machine, as if all pairs of triangles had been tested. Touching counts.
//
// Grid. Its step is a power of two times a's lattice step: the smallest for which all coordinates, counted from a's
// lattice origin, stay within 2^24, though no smaller than 2^-6 of the finer of the two lattices' steps. A vertex moves
// by at most half a step of it along each axis, which is 2^-7 of a lattice step for assets of 16 bits and like size,
// and never more than 2^-24 of the farthest coordinate. a's vertices do not move at all where the grid is not coarser
// than their lattice. The rotation's entries are rounded to 2^-30. Vertices that triangles share stay shared.
//
// Transforms. b is placed in a's local space by to_local(a.transform(), b.transform()), whose error is described in
// transform.hpp: it moves and turns b as a whole. If a is at the origin, b's transform is used unchanged. Exchanging a
// and b may therefore change answers within these errors.
//
// Distances. They are compared by their squares, each within 8 ulp of the exact one. The distance is within 4 ulp of
// that of the rounded meshes, each point within 16 ulp of the largest coordinate of the two placed bounds. If a's scale
// is not 1, the distance is rounded once more; so is the one that a query is given, which is otherwise compared
// exactly. If a is not at the origin, points are moved by to_world().
//
// Touches. Which triangles touch and how many points a touch has is exact. Points that are corners of a triangle are
// exact there, others within 2^-21 of the length of a side; in the world each coordinate adds 16 ulp of the largest
// coordinate of the two placed bounds. The depth is within 2^-20 of the longest distance from a's first corner to
// another, of either triangle, and so is what is left of it after that translation. Where two ways are equally long but
// for this error, the normal is that of either. Triangles in one plane have depth 0, but for it, and a normal of it.
//
// The way out is that of these two triangles alone. Other pairs of the same blobs may need a longer or another one:
// move by what reduce_contacts() leaves of all of them, and query again.
//
// Range. Queries return out_of_range, in O(1), in these cases: a corner of the bounds of b is more than 2^80 of a's
// lattice steps away; one of the scales is not between 2^-100 and 2^100 while a is not at the origin; for distances,
// the bounds are apart by more than 1,024 times the longer one's longest side along some axis, unless max_distance is
// less than half of that: then the result is not_found.
//
// Work. A distance begins with a search of likely places, which takes up to 9 times both depths in additional visits.
// The stack is bounded (docs/benchmarks.md). OBB tests after Gottschalk, Lin and Manocha (1996), triangles after
// Devillers and Guigue (2002); docs/numerics.md has the proofs.
