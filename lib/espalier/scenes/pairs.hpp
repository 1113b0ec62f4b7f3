// Pairs of instances that may touch, or do: of a moving scene with itself, and with a baked scene in the same world.
//
// A candidate pair is one whose boxes touch; a colliding pair also has triangles that touch. Pairs are returned in
// ascending order, in pages: pages that are joined are the list that one large page would be. Both instances of a pair
// have masks that share a bit, and the filter keeps it.
//
// Nothing is remembered from one step to the next: two sorted lists show which pairs have begun and ended
// (docs/scenes.md has an example).
//
// Thread safety: the pairs of a scene with itself use its block for sorting; no other thread may use that scene
// meanwhile. Pairs with a baked scene only read. No call allocates.
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

/// Two instances of a moving scene, by their slots: a < b.
struct InstancePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    friend constexpr auto operator<=>(const InstancePair&, const InstancePair&) = default;
};

/// An instance of a moving scene, by its slot, and one of a baked scene. Behind a pair come those from
/// {moving, {index + 1, 0}} on if `in_tile` is no_instance.in_tile, as that of a mesh is, else from
/// {moving, {index, in_tile + 1}} on.
struct BakedPair {
    std::uint32_t moving = 0;
    InstanceId baked = {0, 0};
    friend constexpr auto operator<=>(const BakedPair&, const BakedPair&) = default;
};

/// The pairs that a query returns. A parameter type: it refers to the callable.
struct PairFilter {
    /// Only pairs of which an instance was moved or inserted since the last end_step().
    bool only_moved = false;
    /// Returns whether a pair is kept; the default keeps all. The second instance is that of the baked scene, if there
    /// is one. It is called more than once for some pairs and must return the same each time. It may read instances of
    /// the scenes and query them; it must not change the moving scene or collect pairs of it with itself.
    FunctionRef<bool(InstanceId, InstanceId)> keep = {};
};

/// A page of pairs: how many were written, and where the next page begins.
template <class Pair>
struct [[nodiscard]] FilledPairs {
    std::size_t count = 0;  ///< pairs written
    Pair next;              ///< where to resume after output_full and work_limit, else behind the last pair; after
                            ///< out_of_range the pair that was refused
    /// ok: complete; output_full: there may be more; work_limit: pairs are missing; else why the query was refused.
    QueryStatus status = QueryStatus::not_open;

    /// Returns the written part of the array that the query was given.
    [[nodiscard]] constexpr auto in(auto& array) const noexcept { return std::span(array).first(count); }
};

/// Writes the pairs of instances whose boxes touch, from the pair `from` on.
///
/// Refuses a scene that is not open or waits for refit(). Cost: one walk of the tree against itself, if the page is the
/// first and has room for all pairs. Every other page takes a walk from each of its slots; a first one that is too
/// small takes both. The cost depends on the number of pairs, which is that of all if all are at one place.
///
/// An array without room gets none of the pairs: enlarge it before the next call.
FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

/// Writes the candidate pairs of which triangles touch, as overlaps() of the two meshes at their places returns. A tile
/// collides if an instance in it does, at its place in the tile's local space.
///
/// `limit` is the work of all calls of overlaps() together (WorkLimit). If a page ends with work_limit and `next`
/// equals `from`, the limit is too small for that pair. Stops with out_of_range at a pair that overlaps() refuses:
/// `next` is that pair, `count` pairs before it are written, and {next.a, next.b + 1} is behind it. Otherwise refuses
/// as collect_candidate_pairs() does. The array of a first page holds candidates meanwhile: with room for all of them
/// there is one walk of the tree. An array without room gets output_full if there is a candidate.
FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  const PairFilter& filter = {}, InstancePair from = {}) noexcept;

/// Writes the pairs of an instance of the moving scene and one of the baked scene that for_each_candidate() visits for
/// its box. Cost: a walk of the baked scene's tree for each instance that counts. Both scenes are in one world: those
/// of a baked scene without an origin are coordinates of the view. One with an origin needs a view that counts from
/// there, as seen_from(moving, baked.source_origin()) does if that is a multiple of 128 steps; others are refused
/// (invalid_argument).
FilledPairs<BakedPair> collect_candidate_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, const PairFilter& filter = {},
                                               BakedPair from = {}) noexcept;
/// Writes those of which triangles touch. Limit and refusals as above; BakedPair describes what is behind a pair.
FilledPairs<BakedPair> collect_colliding_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, WorkLimit limit,
                                               const PairFilter& filter = {}, BakedPair from = {}) noexcept;

}  // namespace espalier
