// Every question about one placement of two blobs, held against the loop over all pairs of triangles.
#pragma once

#include "support/testing.hpp"

#include "support/loops/placed_groups.hpp"

namespace espalier::tests {

/// A blob and what the loop makes of it once, for every placement.
struct PairedBlob {
    explicit PairedBlob(const TestBlob& blob) : test(blob), groups(blob.decoded) {}
    const TestBlob& test;
    TriangleGroups groups;
};

struct PlacementCounts {
    std::uint64_t asked = 0, touching = 0, pairs = 0;
    std::uint64_t repeated = 0;   ///< pairs of references that stand for a pair again
    std::uint64_t refused = 0;    ///< out of range
    std::uint64_t too_far = 0;    ///< for a distance only
    std::uint64_t distances = 0;  ///< above 0
};

/// Besides the public functions.
enum class AskedPaths { all, one_by_turns };

/// What is asked of a placement: contacts always.
struct Questions {
    bool distances = false;
    AskedPaths paths = AskedPaths::all;
};

void check_placement(const PairedBlob& a, const PairedBlob& b, const Transform& placement, const Questions& questions,
                     PlacementCounts& counts);

/// What was asked of both kinds and not refused, and what came of it.
void tell_calls(const std::string& mesh, const PlacementCounts& random, const PlacementCounts& adversarial,
                bool with_distance);

}  // namespace espalier::tests
