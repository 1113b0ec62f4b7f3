// Batches of rays. A ray's answer does not depend on the order of visits (docs/numerics.md), so rays may be answered in
// any company: neighbours that look alike walk the tree as a group. The others are answered one by one, or in turns
// where memory is what they wait for.
#ifndef ESPALIER_RAYS_BATCH_GROUPS_HPP
#define ESPALIER_RAYS_BATCH_GROUPS_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/batch/group.hpp>
#include <runtime/rays/queries.hpp>

ESPALIER_BEGIN_SET

/// One ray after the other, by a query for single rays.
template <RayHit (*closest_hit)(const BlobData&, const Ray&, const TriangleFilter&)>
void closest_hits_one_by_one(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    for (RayHit* const end = hits + count; hits != end; ++hits) *hits = closest_hit(blob, *rays++, no_filter);
}
template <YesNo (*any_hit)(const BlobData&, const Ray&, const TriangleFilter&)>
void any_hits_one_by_one(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count) {
    for (YesNo* const end = occluded + count; occluded != end; ++occluded)
        *occluded = any_hit(blob, *rays++, no_filter);
}

#if ESPALIER_LANES == 1

// One ray after the other: a core without lanes has little to gain from company, and no stack for it.
ESPALIER_QUERY_OF_SET void closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    closest_hits_one_by_one<single_rays::closest_hit>(blob, rays, hits, count);
}

ESPALIER_QUERY_OF_SET void any_hits(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count) {
    any_hits_one_by_one<single_rays::any_hit>(blob, rays, occluded, count);
}

#else

/// Rays that have nothing in common, several on their way at once: first the nodes of all are tested, which the
/// processor does side by side, then each decides where to go on, which is where branches are mispredicted, and while
/// the others do that, its next node comes from memory.
template <class InTurns>
ESPALIER_NOINLINE inline void answer_in_turns(const BlobData& blob, const Ray* rays, const BatchAnswers& answers,
                                              std::size_t count) {
    constexpr unsigned most_under_way = 8;
    struct UnderWay : InTurns {
        std::size_t number;  // of the ray
        unsigned mask;       // of the node's children
    };
    UnderWay places[most_under_way];
    UnderWay* under_way[most_under_way];
    unsigned size = 0;
    std::size_t next = 0;
    const auto set_out = [&](UnderWay& place) {
        for (; next < count; ++next) {
            const QueryStatus status = place.begin(blob, rays[next], answers.hit(next));
            if (status == QueryStatus::ok) {
                place.number = next++;
                return true;
            }
            answers.miss(next, status);
        }
        return false;
    };
    for (UnderWay& place : places)
        if (set_out(place)) under_way[size++] = &place;
    while (size != 0) {
        for (unsigned i = 0; i < size; ++i) under_way[i]->mask = under_way[i]->walk.test(blob, under_way[i]->query);
        unsigned stay = 0;
        for (unsigned i = 0; i < size; ++i) {
            UnderWay& place = *under_way[i];
            bool goes_on = place.advance(blob, place.mask);
            if (!goes_on) {
                place.answer(rays[place.number], answers, place.number);
                goes_on = set_out(place);
            }
            prefetch(node_at<typename InTurns::Node>(blob, place.walk.index).bytes);
            if (goes_on) under_way[stay++] = &place;
        }
        size = stay;
    }
}

/// Whether walks wait for memory: what they read is more than a core's own cache holds, which is 1 to 2 MB.
inline bool is_beyond_cache(const BlobData& blob) {
    constexpr std::size_t cache_bytes = std::size_t{1} << 21;
    return std::size_t{blob.node_count} * format::node_bytes(blob.profile) + blob.leaf_bytes > cache_bytes;
}

template <class Leaf>
inline void answer_strangers(const BlobData& blob, const Ray* rays, const BatchAnswers& answers, std::size_t count) {
    const bool in_turns = is_beyond_cache(blob);
    if (answers.any_will_do()) {
        if (in_turns) answer_in_turns<AnyInTurns<Leaf> >(blob, rays, answers, count);
        else any_hits_one_by_one<any_hit>(blob, rays, answers.occluded, count);
    } else {
        if (in_turns) answer_in_turns<ClosestInTurns<Leaf> >(blob, rays, answers, count);
        else closest_hits_one_by_one<closest_hit>(blob, rays, answers.hits, count);
    }
}

/// Whether the next rays are a group: a few of them are compared with the first, origins by a sixteenth of the asset
/// and directions by a quarter. Only time depends on it. All are compared before the one branch, which a processor
/// foresees better than several.
inline bool look_alike(const BlobData& blob, const Ray* rays, std::size_t count) {
    if (count < rays_in_group) return false;
    const auto longest = [](Vec3 v) { return maximum(maximum(absolute(v.x), absolute(v.y)), absolute(v.z)); };
    const auto distance = [&](Vec3 a, Vec3 b) { return longest({a.x - b.x, a.y - b.y, a.z - b.z}); };
    const float* extent = blob.extent_steps;
    const float near = longest({extent[0], extent[1], extent[2]}) * 0x1p-4f;
    const float similar = longest(rays[0].direction) * 0x1p-2f;
    unsigned alike = 1;
    // mutant(< -> <=) equivalent: the loop takes 5, 10, 15 and then 20
    for (std::size_t i = rays_in_group / 3; i < rays_in_group; i += rays_in_group / 3)
        alike &= static_cast<unsigned>(distance(rays[i].origin, rays[0].origin) * blob.steps_per_unit <= near) &
                 static_cast<unsigned>(distance(rays[i].direction, rays[0].direction) <= similar);
    return alike != 0;
}

inline void answer_batch(const BlobData& blob, const Ray* rays, const BatchAnswers& answers, std::size_t count) {
    // What was looked at is still in the cache when it is its turn.
    constexpr std::size_t longest_look_ahead = 32 * rays_in_group;
    // The longer a run of strangers, the fewer are compared: looking costs some per cent of a cheap ray.
    constexpr std::size_t most_strangers_at_once = 8 * rays_in_group;
    with_leaves_of(blob, [&]<class Leaf>() {
        bool alike = look_alike(blob, rays, count);
        std::size_t step = rays_in_group;
        for (std::size_t first = 0; first < count;) {
            const bool grouped = alike;
            std::size_t end = first;
            do {
                // mutant(< -> <=) equivalent: both branches give the end where exactly one step is left
                end = count - end < step ? count : end + step;
                alike = look_alike(blob, rays + end, count - end);
                if (alike || grouped) step = rays_in_group;
                else if (step < most_strangers_at_once) step *= 2;
                // mutant(without 4, - -> +, - -> right side dropped, < -> <= 2, < -> >= 2) work: how far the loop looks
                // ahead changes only what is in the cache
            } while (end < count && alike == grouped && end - first < longest_look_ahead);
            if (grouped) answer_in_groups<Leaf>(blob, rays + first, answers.from(first), end - first);
            else answer_strangers<Leaf>(blob, rays + first, answers.from(first), end - first);
            first = end;
        }
    });
}

ESPALIER_QUERY_OF_SET void closest_hits(const BlobData& blob, const Ray* rays, RayHit* hits, std::size_t count) {
    answer_batch(blob, rays, {hits, nullptr}, count);
}

ESPALIER_QUERY_OF_SET void any_hits(const BlobData& blob, const Ray* rays, YesNo* occluded, std::size_t count) {
    answer_batch(blob, rays, {nullptr, occluded}, count);
}

#endif

ESPALIER_END_SET

#endif
