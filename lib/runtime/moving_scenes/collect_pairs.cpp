// Candidate and colliding pairs of a moving scene: with itself, and with a baked scene.
#include <array>

#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/touching_pairs.hpp>
#include <runtime/pairs/contacts.hpp>

namespace espalier {

using namespace detail;

namespace {

// Whether the triangles of two placed parts touch, each a mesh or a tile.

/// A mesh or a tile at a place.
struct PlacedPart {
    MeshOrTile part;
    Transform transform;
};

/// Returns out_of_range for a transform into a tile that no floats hold: those of instances are valid.
QueryStatus find_collision_of_meshes(const Blob& a, const Transform& at_a, const Blob& b, const Transform& at_b,
                                     PairWork& work) {
    const QueryStatus status = find_first_contact(PlacedBlob(a, at_a), PlacedBlob(b, at_b), work).status;
    return status == QueryStatus::invalid_argument ? QueryStatus::out_of_range : status;
}

/// Calls `collide(mesh, transform)` for each mesh of a tile whose box touches a box in its local space, until one
/// collides or the work is done. Returns the last status.
template <class Collide>
QueryStatus for_each_mesh_near(const BakedScene& tile, const Box& box, Collide collide) {
    QueryStatus status = QueryStatus::not_found;
    const QueryStatus end = for_each_candidate(tile, box, [&](InstanceId id) {
        const std::byte* const record = record_of(data_of(tile), id);
        status = collide(*part_of(data_of(tile), record).mesh, transform_of(record));
        return status == QueryStatus::not_found ? Visit::next : Visit::stop;
    });
    return is_refused(end) ? QueryStatus::out_of_range : status;
}

QueryStatus find_collision_with_tile(const Blob& mesh, const Transform& at_mesh, const BakedScene& tile,
                                     const Transform& at_tile, PairWork& work) {
    const Transform in_tile = to_local(at_tile, at_mesh);
    return for_each_mesh_near(tile, box_around(bounds_of(data_of(mesh)), in_tile),
                              [&](const Blob& other, const Transform& at_other) {
                                  return find_collision_of_meshes(mesh, in_tile, other, at_other, work);
                              });
}

QueryStatus find_collision_of_tiles(const BakedScene& a, const Transform& at_a, const BakedScene& b,
                                    const Transform& at_b, PairWork& work) {
    const Transform in_a = to_local(at_a, at_b);
    return for_each_mesh_near(a, box_around(bounds_of(b), in_a), [&](const Blob& mesh, const Transform& at_mesh) {
        return find_collision_with_tile(mesh, at_mesh, b, in_a, work);
    });
}

/// Returns ok if triangles of the two parts touch, not_found, work_limit, or why overlaps() refuses their meshes.
QueryStatus find_collision(const PlacedPart& a, const PlacedPart& b, PairWork& work) {
    if (a.part.mesh == nullptr && b.part.mesh == nullptr)
        return find_collision_of_tiles(*a.part.tile, a.transform, *b.part.tile, b.transform, work);
    if (a.part.mesh == nullptr)
        return find_collision_with_tile(*b.part.mesh, b.transform, *a.part.tile, a.transform, work);
    if (b.part.mesh == nullptr)
        return find_collision_with_tile(*a.part.mesh, a.transform, *b.part.tile, b.transform, work);
    return find_collision_of_meshes(*a.part.mesh, a.transform, *b.part.mesh, b.transform, work);
}

/// Returns a part at its place, seen from an origin.
PlacedPart placed_part(const MovingScene& scene, const InstanceSlot& slot, const std::int32_t (&origin)[3]) {
    return {part_of(scene, slot.mesh), seen_transform(slot, origin, scene.step_exponent())};
}

QueryStatus find_collision(const MovingScene& scene, const SceneBlock& block, const InstancePair& pair,
                           PairWork& work) {
    // Seen from the origin of the first, so that no view has other pairs.
    const InstanceSlot &a = block.slots[pair.a], &b = block.slots[pair.b];
    return find_collision(placed_part(scene, a, a.origin), placed_part(scene, b, a.origin), work);
}

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
    return find_collision(mover, other, work);
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
    PairPage<InstancePair> page = {pairs, {0, touching.end(), QueryStatus::ok}};
    const auto take_if_colliding = [&](const InstancePair& pair) {
        return page.take(pair, page.is_full() ? QueryStatus::output_full : find_collision(scene, block, pair, work));
    };
    std::size_t candidates = 0;
    if (takes_shortcut(from == InstancePair{}) && touching.collect_all(pairs, candidates)) {
        // Those that collide stay.
        for (const InstancePair& pair : pairs.first(candidates))
            if (take_if_colliding(InstancePair(pair)) == Visit::stop) break;
    } else {
        touching.for_each_from(from, take_if_colliding);
    }
    return page.filled;
}

/// Writes the pairs of an instance of a moving scene and one of a baked scene that its box meets, if test(slot,
/// instance) returns ok; not_found leaves a pair out.
template <class Test>
FilledPairs<BakedPair> collect_baked(const MovingScene& moving, const BakedScene& baked, std::span<BakedPair> pairs,
                                     const PairFilter& filter, BakedPair from, Test test) {
    const QueryStatus readiness = readiness_of(moving, baked);
    if (readiness != QueryStatus::ok) return {0, from, readiness};
    const SceneBlock block = block_of(moving);
    PairPage<BakedPair> page = {pairs, {0, {block.head->slots_used, {0, 0}}, QueryStatus::ok}};
    for (std::uint32_t number = from.moving; number < block.head->slots_used; ++number) {
        const InstanceSlot& slot = block.slots[number];
        if (!is_live(slot) || (filter.only_moved && !has_moved(block, number))) continue;
        const Box box = box_in_view(moving, slot.box);
        const auto take = [&](InstanceId instance) {
            const BakedPair pair = {number, instance};
            if (pair < from || (filter.keep && !filter.keep(InstanceId{number}, instance))) return Visit::next;
            return page.take(pair, test(slot, instance));
        };
        if (for_each_candidate(baked, box, take, block.masks[number]) == QueryStatus::stopped) break;
    }
    return page.filled;
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
    const auto keep_all = [](const InstanceSlot&, InstanceId) { return QueryStatus::ok; };
    return collect_baked(moving, baked, pairs, filter, from, keep_all);
}

FilledPairs<BakedPair> collect_colliding_pairs(const MovingScene& moving, const BakedScene& baked,
                                               std::span<BakedPair> pairs, WorkLimit limit, const PairFilter& filter,
                                               BakedPair from) noexcept {
    PairWork work = {limit.visits()};
    return collect_baked(moving, baked, pairs, filter, from, [&](const InstanceSlot& slot, InstanceId instance) {
        return find_collision(moving, slot, baked, instance, work);
    });
}

}  // namespace espalier
