// Collecting pairs of instances of a moving scene while counting the work, for cost models and tests of the tree.
//
// The counts are the same on every machine, except on small cores, which search slot by slot. A refused call counts
// nothing.
//
// Thread safety is that of the calls without counters (pairs.hpp). No call allocates.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/pair.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/scenes/pairs.hpp>
#include <espalier/advanced/statistics.hpp>

namespace espalier {

/// The work of searching for pairs of instances, accumulated over calls. A first page that is too small for all pairs
/// traverses the tree once for all of them and then, like each later page, once for each of its slots. Both count.
struct SceneCounters {
    std::uint64_t box_tests = 0;  ///< tests of a box against all boxes of a node
    /// Pairs of instances whose boxes touch, before masks and a filter select any. With PairFilter::only_moved, if few
    /// instances have moved, only pairs with a moved instance are counted, and a pair of two moved instances counts
    /// twice. A traversal for a slot counts all pairs of that slot.
    std::uint64_t pairs = 0;
};

/// Returns what collect_candidate_pairs() returns and adds its work to `counters`. Runs the scalar code.
FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  SceneCounters& counters, const PairFilter& filter = {},
                                                  InstancePair from = {}) noexcept;
/// Returns what collect_colliding_pairs() returns, and adds the work of the search to `counters` and that of comparing
/// the candidates' triangles to `of_triangles`. Runs the scalar code for the search.
FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  SceneCounters& counters, PairCounters& of_triangles,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

}  // namespace espalier
