// The inner queries of each instruction set that tests run on (chosen_instruction_set.hpp), by name: the scalar ones
// first.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <runtime/pairs/queries.hpp>
#include <runtime/proximity/queries.hpp>
#include <runtime/rays/queries.hpp>

#include "support/base/same_bits.hpp"

namespace espalier::tests {

struct InstructionPath {
    const char* name;
    decltype(&detail::scalar::closest_hit) closest_hit;
    decltype(&detail::scalar::first_hits) first_hits;
    decltype(&detail::scalar::any_hit) any_hit;
    decltype(&detail::scalar::every_hit) every_hit;
    decltype(&detail::scalar::every_crossing) every_crossing;
    decltype(&detail::scalar::closest_hits) closest_hits;
    decltype(&detail::scalar::any_hits) any_hits;
    decltype(&detail::scalar::find_overlaps) find_overlaps;
    decltype(&detail::scalar::find_nearest) find_nearest;
    decltype(&detail::scalar::may_hit) may_hit;
    decltype(&detail::scalar::closest_hit_on_lattice) closest_hit_on_lattice;
    decltype(&detail::scalar::any_hit_on_lattice) any_hit_on_lattice;
    decltype(&detail::scalar::search_pairs) search_pairs;

    // The searches through two blobs; `work` is what is left of it.
    QueryStatus touching_pairs(const detail::PairFrame& frame, FunctionRef<Visit(const detail::TrianglePair&)> visit,
                               std::uint64_t& work) const;
    QueryStatus nearest_pair(const detail::PairFrame& frame, float radius, bool any, detail::FoundTriangles& best,
                             bool& found, std::uint64_t& work) const;

    // What callers get of the queries by distance.
    bool any_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere) const;
    /// False when the visitor stopped it.
    bool every_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere, std::uint32_t first,
                       FunctionRef<Visit(TriangleId)> visit) const;
    bool closest_triangle(const detail::BlobData& blob, const detail::RoundedPoint& point,
                          detail::FoundNearest& best) const;
    /// How many there are; they are not finished (nearest_to_local.hpp).
    std::size_t closest_triangles(const detail::BlobData& blob, const detail::RoundedPoint& point,
                                  std::span<ClosestPoint> nearest) const;
    bool may_overlap(const detail::BlobData& blob, const detail::RoundedPoint& sphere, std::int32_t steps,
                     QueryCounters& counters) const;
    detail::SquaredBounds closest_bounds(const detail::BlobData& blob, const detail::RoundedPoint& point,
                                         std::int32_t steps, QueryCounters& counters) const;
};

const std::vector<InstructionPath>& instruction_paths();

inline bool same_corners(const detail::LatticeTriangle& a, const detail::LatticeTriangle& b) {
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (a.corner[i][k] != b.corner[i][k]) return false;
        }
    }
    return true;
}

inline bool same_bits(const detail::FoundNearest& a, const detail::FoundNearest& b) {
    return same_bits(a.distance.squared, b.distance.squared) && same_bits(a.distance.u, b.distance.u) &&
           same_bits(a.distance.v, b.distance.v) && a.distance.numerator == b.distance.numerator &&
           a.distance.denominator == b.distance.denominator && a.index == b.index &&
           a.distance.feature == b.distance.feature && same_corners(a.triangle, b.triangle);
}

}  // namespace espalier::tests
