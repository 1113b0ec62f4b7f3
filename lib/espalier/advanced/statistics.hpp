// Queries that count their work, for heat maps, cost models and tests of the culling.
//
// The counts are the same on every machine, and a refused query counts nothing. Any number of threads may query the
// same blob, each with counters of its own. No call allocates.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/pair.hpp>
#include <espalier/ray.hpp>

namespace espalier {

/// The work of queries on one blob, accumulated over calls.
struct QueryCounters {
    std::uint64_t nodes = 0;       ///< tests of a node's children, at most four per node, or eight in profile fast
    std::uint64_t leaves = 0;      ///< leaves decoded
    std::uint64_t groups = 0;      ///< groups of 8 triangles begun in those leaves: what SIMD tests at once
    std::uint64_t triangles = 0;   ///< triangles that went through the filter
    std::uint64_t candidates = 0;  ///< triangles that were decided exactly

    void count_node() { ++nodes; }
    void count_leaf(unsigned of_triangles) {
        ++leaves;
        groups += (of_triangles + 7) / 8;
        triangles += of_triangles;
    }
    void count_candidates(unsigned count) { candidates += count; }
};

/// Returns what raycast() returns and adds its work to `counters`. Runs the scalar code, so that the counts are the
/// same on every machine.
RayHit raycast(const Blob& blob, const Ray& ray, QueryCounters& counters) noexcept;

/// The work of queries on two blobs, accumulated over calls.
struct PairCounters {
    /// Pairs of nodes or leaves that were visited. A single call completes with a WorkLimit of as many; two blobs whose
    /// bounds are clearly apart take one.
    std::uint64_t box_pairs = 0;
    std::uint64_t leaf_pairs = 0;      ///< pairs of leaves whose triangles were compared
    std::uint64_t triangle_pairs = 0;  ///< sum of the products of the triangle counts of these pairs

    void count_leaves(unsigned a_triangles, unsigned b_triangles) {
        ++leaf_pairs;
        triangle_pairs += std::uint64_t{a_triangles} * b_triangles;
    }
};

/// Returns what first_contact() returns, in the same time, and adds its work to `counters`.
PairContact first_contact(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit, PairCounters& counters) noexcept;
/// Returns what distance() returns, in the same time, and adds its work to `counters`.
BlobDistance distance(const PlacedBlob& a, const PlacedBlob& b, WorkLimit limit, float max_distance,
                      PairCounters& counters) noexcept;

}  // namespace espalier
