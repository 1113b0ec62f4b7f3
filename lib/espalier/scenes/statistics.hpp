// Pairs of instances that moving scenes find while they count their work: for cost models and tests of the tree.
//
// Counts are the same on every machine, except on small cores, which search slot by slot. A refused call counts
// nothing.
//
// Thread safety: that of the calls without counters (pairs.hpp). No call allocates.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/pair.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>
#include <espalier/advanced/statistics.hpp>

namespace espalier {

/// The work of the search for pairs of instances, added up over calls. A first page that is too small for all pairs
/// takes a walk for all, and like each later page one for each of its slots. Both count.
struct SceneCounters {
    std::uint64_t box_tests = 0;  ///< tests of one box against the boxes of a node
    /// Pairs of instances whose boxes touch, before masks and a filter select them. With PairFilter::only_moved, if few
    /// have moved, those of which one has moved; if both have, the pair counts twice. A walk for a slot counts all its
    /// pairs.
    std::uint64_t pairs = 0;
};

/// Returns what collect_candidate_pairs() returns, and adds its work to `counters`. Uses the scalar code path.
FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  SceneCounters& counters, const PairFilter& filter = {},
                                                  InstancePair from = {}) noexcept;
/// Returns what collect_colliding_pairs() returns, and adds the work of the walk to `counters` and that of the
/// candidates' triangles to `of_triangles`. Uses the scalar code path for the walk.
FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  SceneCounters& counters, PairCounters& of_triangles,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

}  // namespace espalier
