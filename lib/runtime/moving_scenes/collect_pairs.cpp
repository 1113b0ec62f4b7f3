// Candidate and colliding pairs of a moving scene: with itself, and with a baked scene.
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/scenes/pairs.hpp>
#include <espalier/scenes/statistics.hpp>

#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/collision.hpp>
#include <runtime/moving_scenes/touching_pairs.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Returns a part at its place, seen from an origin.
PlacedPart placed_part(const MovingScene& scene, const InstanceSlot& slot, const std::int32_t (&origin)[3]) {
    return {part_of(scene, slot.mesh), seen_transform(slot, origin, scene.step_exponent())};
}

QueryStatus find_collision(const MovingScene& scene, const SceneBlock& block, const InstancePair& pair,
                           PairWork& work) {
    // Seen from the origin of the first, so that no view has other pairs.
    const InstanceSlot &a = block.slots[pair.a], &b = block.slots[pair.b];
    return detail::find_collision(placed_part(scene, a, a.origin), placed_part(scene, b, a.origin), work);
}

/// A walk over the instances of a moving scene, and for each over those of a baked scene that its box meets.
class BakedPairWalk {
public:
    BakedPairWalk(const MovingScene& moving, const BakedScene& baked, const PairFilter& filter, BakedPair from)
        : moving_(moving), block_(block_of(moving)), baked_(baked), filter_(filter), from_(from) {}

    /// Calls `visit(pair, slot)` with each pair that counts, in ascending order, until it returns stop.
    template <class OnPair>
    void for_each(OnPair visit) const {
        for (std::uint32_t number = from_.moving; number < block_.head->slots_used; ++number) {
            const InstanceSlot& slot = block_.slots[number];
            if (!is_live(slot) || (filter_.only_moved && !has_moved(block_, number))) continue;
            const Box box = box_in_view(moving_, slot.box);
            const auto visit_baked = [&](InstanceId baked) {
                const BakedPair pair = {number, baked};
                if (pair < from_ || (filter_.keep && !filter_.keep(InstanceId{number}, baked))) return Visit::next;
                return visit(pair, slot);
            };
            if (for_each_candidate(baked_, box, visit_baked, block_.masks[number]) == QueryStatus::stopped) return;
        }
    }
    [[nodiscard]] BakedPair end() const { return {block_.head->slots_used, {0, 0}}; }

private:
    const MovingScene& moving_;
    const SceneBlock block_;
    const BakedScene& baked_;
    const PairFilter& filter_;
    BakedPair from_;
};

/// Whether the coordinates of both count from one place. Those of a baked scene without an origin are the view's.
bool have_one_origin(const MovingScene& moving, const BakedScene& baked) {
    using Bits = std::array<std::uint64_t, 3>;  // small cores have no arithmetic for float64
    const Bits of_moving = std::bit_cast<Bits>(moving.origin()), of_baked = std::bit_cast<Bits>(baked.source_origin());
    bool is_zero = true, is_equal = true;
    for (std::size_t k = 0; k < 3; ++k) {
        is_zero = is_zero && of_baked[k] << 1 == 0;  // -0 as well
        is_equal = is_equal && (of_baked[k] == of_moving[k] || (of_baked[k] | of_moving[k]) << 1 == 0);
    }
    return is_zero || is_equal;
}

/// Returns ok if both scenes can be walked, else why not.
QueryStatus readiness_of(const MovingScene& moving, const BakedScene& baked) {
    if (!baked) return QueryStatus::not_open;
    const QueryStatus status = detail::readiness_of(moving);
    return status != QueryStatus::ok || have_one_origin(moving, baked) ? status : QueryStatus::invalid_argument;
}

/// Returns the mesh of an instance, seen from the space in which its transform leads: that of the scene or of a tile.
PlacedPart part_in(const SceneData& holder, std::uint32_t number) {
    const std::byte* const record = record_of(holder, InstanceId{number});
    return {part_of(holder, record), transform_of(record)};
}

QueryStatus find_collision(const MovingScene& moving, const InstanceSlot& slot, const BakedScene& baked,
                           InstanceId instance, PairWork& work) {
    PlacedPart mover = placed_part(moving, slot, MovingSceneAccess::origin(moving));
    PlacedPart other = part_in(data_of(baked), instance.index);
    if (instance.in_tile != no_instance.in_tile) {
        mover.transform = to_local(other.transform, mover.transform);
        other = part_in(data_of(*other.part.tile), instance.in_tile);
    }
    return detail::find_collision(mover, other, work);
}

FilledPairs<InstancePair> collect_candidates(MovingScene& scene, std::span<InstancePair> pairs,
                                             const PairFilter& filter, InstancePair from, SelfJoin join) {
    const QueryStatus readiness = detail::readiness_of(scene);
    if (readiness != QueryStatus::ok) return {0, from, readiness};
    SceneBlock block = block_of(scene);
    return collect_touching_pairs(block, pairs, filter, from, join);
}

FilledPairs<InstancePair> collect_colliding(MovingScene& scene, std::span<InstancePair> pairs, PairWork& work,
                                            const PairFilter& filter, InstancePair from, SelfJoin join) {
    const QueryStatus readiness = detail::readiness_of(scene);
    if (readiness != QueryStatus::ok) return {0, from, readiness};
    SceneBlock block = block_of(scene);
    TouchingPairs touching(block, filter, join);
    FilledPairs<InstancePair> filled = {0, touching.end(), QueryStatus::ok};
    const auto add_if_colliding = [&](const InstancePair& pair) {
        QueryStatus status = QueryStatus::output_full;
        if (filled.count < pairs.size()) status = find_collision(scene, block, pair, work);
        if (status == QueryStatus::not_found) return Visit::next;
        if (status == QueryStatus::ok) {
            pairs[filled.count++] = pair;
            return Visit::next;
        }
        filled.next = pair;
        filled.status = status;
        return Visit::stop;
    };
    std::size_t candidates = 0;
    if (takes_shortcut(from == InstancePair{}) && touching.collect_all(pairs, candidates)) {
        // Those that collide stay.
        for (const InstancePair& pair : pairs.first(candidates))
            if (add_if_colliding(InstancePair(pair)) == Visit::stop) break;
    } else {
        touching.for_each_from(from, add_if_colliding);
    }
    return filled;
}

/// The walks that add their work to counters.
struct CountedJoin {
    SceneCounters& counters;
    void operator()(const SceneBlock& block, JoinedSlots joined, std::uint32_t slot,
                    const OnTouchingBoxes& visit) const {
        count_join(block, joined, slot, visit, counters);
    }
};

}  // namespace

FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  const PairFilter& filter, InstancePair from) noexcept {
    return collect_candidates(scene, pairs, filter, from, join_by_best_set);
}

FilledPairs<InstancePair> collect_candidate_pairs(MovingScene& scene, std::span<InstancePair> pairs,
                                                  SceneCounters& counters, const PairFilter& filter,
                                                  InstancePair from) noexcept {
    return collect_candidates(scene, pairs, filter, from, CountedJoin{counters});
}

FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  const PairFilter& filter, InstancePair from) noexcept {
    PairWork work = {limit.visits()};
    return collect_colliding(scene, pairs, work, filter, from, join_by_best_set);
}

FilledPairs<InstancePair> collect_colliding_pairs(MovingScene& scene, std::span<InstancePair> pairs, WorkLimit limit,
                                                  SceneCounters& counters, PairCounters& of_triangles,
                                                  const PairFilter& filter, InstancePair from) noexcept {
    PairWork work = {limit.visits(), &of_triangles};
    const FilledPairs<InstancePair> filled = collect_colliding(scene, pairs, work, filter, from, CountedJoin{counters});
    of_triangles.box_pairs += limit.visits() - work.left;
    return filled;
}

FilledPairs<BakedPair> collect_candidate_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, const PairFilter& filter,
                                               BakedPair from) noexcept {
    FilledPairs<BakedPair> filled = {0, from, readiness_of(moving, baked)};
    if (filled.status != QueryStatus::ok) return filled;
    const BakedPairWalk walk(moving, baked, filter, from);
    filled.next = walk.end();
    walk.for_each([&](const BakedPair& pair, const InstanceSlot&) {
        if (filled.count == pairs.size()) {
            filled.next = pair;
            filled.status = QueryStatus::output_full;
            return Visit::stop;
        }
        pairs[filled.count++] = pair;
        return Visit::next;
    });
    return filled;
}

FilledPairs<BakedPair> collect_colliding_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, WorkLimit limit, const PairFilter& filter,
                                               BakedPair from) noexcept {
    FilledPairs<BakedPair> filled = {0, from, readiness_of(moving, baked)};
    if (filled.status != QueryStatus::ok) return filled;
    const BakedPairWalk walk(moving, baked, filter, from);
    filled.next = walk.end();
    PairWork work = {limit.visits()};
    walk.for_each([&](const BakedPair& pair, const InstanceSlot& slot) {
        QueryStatus status = find_collision(moving, slot, baked, pair.baked, work);
        if (status == QueryStatus::not_found) return Visit::next;
        if (status == QueryStatus::ok && filled.count == pairs.size()) status = QueryStatus::output_full;
        if (status == QueryStatus::ok) {
            pairs[filled.count++] = pair;
            return Visit::next;
        }
        filled.next = pair;
        filled.status = status;
        return Visit::stop;
    });
    return filled;
}

}  // namespace espalier
