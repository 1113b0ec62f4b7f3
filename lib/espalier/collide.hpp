// Two blobs against each other: whether their surfaces touch, where, and how far apart they are.
//
// Placement. b stands in a's space: a point x of b is scaled, turned, then moved: rotation * (scale * x) + translation.
// Numbers. Both meshes are rounded once onto one grid of integers, whose step is a power of two times a's lattice step:
// the smallest for which all coordinates, counted from a's lattice origin, stay within 2^24, though no smaller than
// 2^-6 of the finer of the two lattices' steps. A vertex moves by at most half a step of it along each axis, which is
// 2^-7 of a lattice step for assets of 16 bits and like size, and never more than 2^-24 of the farthest coordinate; a's
// vertices do not move at all where the grid is not coarser than their lattice. The rotation's entries are rounded to
// 2^-30. Vertices that triangles share stay shared. Of these two meshes of integers every answer is exact (touching
// counts), as if all pairs had been asked, and the same on every machine; docs/numerics.md has the proofs.
// Arguments. Any bit pattern is safe. QueryStatus::invalid_argument for NaN, infinities, a rotation of length 0, a
// scale that is not above 0, a maximal distance that is negative or NaN (infinity is fine); out_of_range when a blob's
// corner is placed more than 2^80 of a's lattice steps away, and for distances when the bounds are apart by more than
// 1,024 times the longer one's longest side, along some axis, unless max_distance is less than half of that: then
// nothing is found. All of it O(1), and refused queries leave results alone. Cost. The stack is bounded
// (docs/benchmarks.md), steps by the product of the two trees' sizes, and for distances by 9 times both depths besides,
// which a first look at likely places takes: whoever places meshes that others made gives a work limit. It counts pairs
// of nodes or leaves, that look's too; when it is reached, the answer is work_limit, at the same pair on every machine.
// OBB tests after Gottschalk, Lin and Manocha (1996), triangles after Devillers and Guigue (2002).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Of any length but zero; the default turns nothing.
struct Quaternion {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
    float w = 1.0f;
};

/// Where the second blob stands in the first one's space.
struct Placement {
    Quaternion rotation;
    Vec3 translation;
    float scale = 1.0f;
};

/// A triangle of each blob.
struct TrianglePair {
    Triangle a;
    Triangle b;
    friend constexpr auto operator<=>(const TrianglePair&, const TrianglePair&) = default;
};

/// Pairs of nodes or leaves that a query may visit.
struct WorkLimit {
    std::uint64_t pairs = ~std::uint64_t{0};
};

/// Whether any triangle of a touches any of b. `answer` is written with QueryStatus::ok, and with work_limit: false.
QueryStatus collides(const Blob& a, const Blob& b, const Placement& placement, bool& answer,
                     WorkLimit limit = {}) noexcept;

/// One pair that touches: the first that the search for any finds, the same on every machine. `found` as in collides;
/// `contact` is untouched unless something is found.
QueryStatus first_contact(const Blob& a, const Blob& b, const Placement& placement, TrianglePair& contact, bool& found,
                          WorkLimit limit = {}) noexcept;

/// Every pair that touches, each once, until the visitor answers stop (the status is ok then too). The order is that
/// of the two trees, the same on every machine, and not sorted. Refused with has_copies when either blob has copies.
/// With work_limit the visitor has seen a part.
QueryStatus for_each_contact(const Blob& a, const Blob& b, const Placement& placement,
                             FunctionRef<Visit(const TrianglePair&)> visit, WorkLimit limit = {});

/// The same into an array: the first contacts.size() pairs. `count` says how many were written; output_full when there
/// are more.
QueryStatus all_contacts(const Blob& a, const Blob& b, const Placement& placement, std::span<TrianglePair> contacts,
                         std::size_t& count, WorkLimit limit = {}) noexcept;

/// How near two blobs are. Points in a's space.
struct PairDistance {
    float distance = 0.0f;  ///< within 4 ulp of that of the two rounded meshes
    Vec3 on_a;              ///< each within 16 ulp of the largest coordinate of the two placed bounds
    Vec3 on_b;
    TrianglePair pair;
};

/// The smallest distance of the two surfaces within max_distance (which may be infinite). Distances are compared by
/// their squares, each within 8 ulp of the exact one; of equal ones the lowest a wins, then the lowest b. Where the
/// surfaces touch, the distance is 0 and the pair the first that this search finds. `nearest` is untouched unless
/// something is found; with work_limit it may be one that is not the nearest.
QueryStatus minimum_distance(const Blob& a, const Blob& b, const Placement& placement, float max_distance,
                             PairDistance& nearest, bool& found, WorkLimit limit = {}) noexcept;

/// Whether the surfaces are within that distance of each other: decided exactly, equal counts.
QueryStatus within_distance(const Blob& a, const Blob& b, const Placement& placement, float distance, bool& answer,
                            WorkLimit limit = {}) noexcept;

}  // namespace espalier
