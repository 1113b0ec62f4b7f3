// What shapes find, still in lattice units.
#pragma once

#include <cstdint>

#include <espalier/ray.hpp>
#include <runtime/answers/best_k.hpp>
#include <runtime/blob/duplicate_references.hpp>
#include <runtime/kernels/point_triangle.hpp>
#include <runtime/lattice/round_point.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// A triangle that a shape found.
struct Found {
    std::uint32_t index = 0;      ///< of the triangle: the lowest of its references
    std::uint32_t reference = 0;  ///< the storage index at which it was found
};

/// Returns what was found at a storage index of a leaf.
template <class Leaf>
inline Found found_at(const Leaf& leaf, std::uint32_t reference) {
    if constexpr (Leaf::may_have_duplicates) return {owner_of(*leaf.blob, reference), reference};
    else return {reference, reference};
}

/// The one nearest to a point.
struct FoundNearest : Found {
    PointDistance distance;
    LatticeTriangle triangle;

    [[nodiscard]] float key() const { return distance.squared; }
    /// Returns the limit for boxes once this triangle is found.
    [[nodiscard]] float limit(float before) const { return minimum(key() * distance_slack, before); }
};

/// Whether a is nearer than b, or as near and of a lower index.
template <class Kind>
bool comes_before(const Kind& a, const Kind& b) {
    // mutant(< -> <= 2) equivalent: the same triangle, again from a leaf with a copy, gives the same values
    return a.key() < b.key() || (a.key() == b.key() && a.index < b.index);
}

struct FoundHit {
    TriangleHit hit;
    std::uint32_t index;
};

}  // namespace espalier::detail
