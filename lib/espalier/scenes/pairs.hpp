// Pairs of instances that may touch or do touch, within a moving scene or between it and a baked scene in the same
// world.
//
// Two instances are a candidate pair if their boxes touch, and a colliding pair if their triangles touch as well. Only
// pairs whose masks share a bit and that the filter keeps are returned. They come in ascending order and in pages:
// joined together, the pages are the list that a single large page would hold.
//
// Nothing is remembered from one step to the next. Comparing the sorted lists of two steps shows which pairs began and
// which ended (docs/scenes.md has an example).
//
// Thread safety: finding pairs within a scene uses its block for sorting, so no other thread may use that scene
// meanwhile. Finding pairs with a baked scene only reads. No call allocates.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/base/function_ref.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <espalier/pair.hpp>
#include <espalier/scene.hpp>
#include <espalier/status.hpp>

namespace espalier {

/// Two instances of a moving scene, given by their slots, where a < b.
struct InstancePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    friend constexpr auto operator<=>(const InstancePair&, const InstancePair&) = default;
};

/// An instance of a moving scene, given by its slot, and one of a baked scene. To resume after a pair, begin at
/// {moving, {index + 1, 0}} if its `in_tile` is no_instance.in_tile, as it is for a mesh, and otherwise at {moving,
/// {index, in_tile + 1}}.
struct BakedPair {
    std::uint32_t moving = 0;
    InstanceId baked = {0, 0};
    friend constexpr auto operator<=>(const BakedPair&, const BakedPair&) = default;
};

/// Selects the pairs that a query returns. Use it as a parameter only, since it refers to the callable.
struct PairFilter {
    /// Selects only pairs with an instance that was moved or inserted since the last end_step().
    bool only_moved = false;
    /// Returns whether to keep a pair; the default keeps all. The second instance is that of the baked scene, if there
    /// is one. The callable may be called more than once for a pair and must return the same each time. It may read and
    /// query the scenes, but must neither change the moving scene nor collect pairs within it.
    FunctionRef<bool(InstanceId, InstanceId)> keep = {};
};

/// A page of pairs: how many were written, and where the next page begins.
template <class Pair>
struct [[nodiscard]] FilledPairs {
    std::size_t count = 0;  ///< number of pairs written
    Pair next;  ///< where to resume after output_full and work_limit; the refused pair after out_of_range; otherwise
                ///< after the last pair
    /// ok: the list is complete. output_full: there may be more pairs. work_limit: pairs are missing. Any other status
    /// tells why the query was refused.
    QueryStatus status = QueryStatus::not_open;

    /// Returns the part of the array that the query filled. Pass the array that the query was given.
    [[nodiscard]] constexpr auto in(auto& array) const noexcept { return std::span(array).first(count); }
};

/// Writes the pairs of instances whose boxes touch, from the pair `from` on.
///
/// Refuses a scene that is not open or waits for refit(). Cost: a first page with room for all pairs traverses the tree
/// once, against itself. Every other page traverses the tree once for each of its slots; a first page that is too small
/// does both. The cost depends on the number of pairs, and if all instances are in one place, every two of them are a
/// pair.
///
/// An array without room receives none of the pairs: enlarge it before the next call.
FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

/// Writes the candidate pairs whose triangles touch, as overlaps() of the two placed meshes decides. A tile collides if
/// an instance in it does, as placed in the tile's local space.
///
/// `limit` bounds the work of all calls of overlaps() together. If a page ends with work_limit and `next` equals
/// `from`, the limit is too small for that pair. At a pair that overlaps() refuses, the page ends with out_of_range:
/// `next` is that pair, `count` pairs before it were written, and {next.a, next.b + 1} resumes after it. Otherwise
/// refuses what collect_candidate_pairs() refuses.
///
/// The array of a first page temporarily holds the candidates; if it has room for all of them, the tree is traversed
/// only once. An array without room gets output_full if there is a candidate.
FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

/// Writes the pairs of an instance of the moving scene and an instance of the baked scene that for_each_candidate()
/// visits for its box. Cost: one traversal of the baked scene's tree for each instance that the filter selects.
///
/// Both scenes must be in the same world. If the baked scene has no origin, its coordinates are those of the view. If
/// it has one, the view must count from there, as that of seen_from(moving, baked.source_origin()) does if the origin
/// is a multiple of 128 steps. Other views are refused (invalid_argument).
FilledPairs<BakedPair> collect_candidate_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, const PairFilter& filter = {},
                                               BakedPair from = {}) noexcept;
/// Writes those of these pairs whose triangles touch. Limit and refusals are as above; to resume after a pair, see
/// BakedPair.
FilledPairs<BakedPair> collect_colliding_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, WorkLimit limit,
                                               const PairFilter& filter = {}, BakedPair from = {}) noexcept;

}  // namespace espalier
