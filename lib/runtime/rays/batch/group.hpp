// Rays that are alike walk the tree together: a node is fetched once for all of them, a leaf is decoded once. The idea
// of one walk with a list of its rays goes back to Wald, Slusallek, Benthin and Wagner (2001).
#ifndef ESPALIER_RAYS_BATCH_GROUP_HPP
#define ESPALIER_RAYS_BATCH_GROUP_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/rays/answers.hpp>
#include <runtime/rays/prepare_ray.hpp>

ESPALIER_BEGIN_SET

/// Where the answers go: closest hits, or whether there is any.
struct BatchAnswers {
    RayHit* hits;     ///< null where any hit will do
    YesNo* occluded;  ///< else null

    [[nodiscard]] bool any_will_do() const { return hits == nullptr; }
    [[nodiscard]] BatchAnswers from(std::size_t first) const {
        return any_will_do() ? BatchAnswers{nullptr, occluded + first} : BatchAnswers{hits + first, nullptr};
    }
    /// Returns the place of a closest hit, or null where any hit will do.
    [[nodiscard]] RayHit* hit(std::size_t number) const { return any_will_do() ? nullptr : hits + number; }
    /// Writes the answer for a ray without a hit.
    void miss(std::size_t number, QueryStatus status) const {
        if (any_will_do()) occluded[number] = YesNo(status);
        else hits[number] = miss_with(status);
    }
};

/// The closest hit, or the first that is found: one answer for both, since twice as much code would be slower than a
/// branch that is always the same.
struct BatchHit : ClosestHit<Ray> {
    template <class SomeLeaf>
    Visit decide(const LatticeRay& ray, const SomeLeaf& leaf, unsigned slot) {
        if (best != nullptr) return ClosestHit<Ray>::decide(ray, leaf, slot);
        if (!is_hit(leaf, slot, ray)) return Visit::next;
        volume_bits = 1;  // of no meaning but that there is one
        limit = -1.0f;    // no key is as small
        return Visit::stop;
    }
};

/// Aligned to a size that is a power of two: a shift then finds a ray of a group.
template <class Leaf>
struct alignas(32) RayInBatch {
    PreparedRayIn<RayLanesOf<typename Leaf::Node>> prepared = {};
    RayQuery<Leaf, BatchHit> query = {{prepared.ray, prepared.lanes()}, {{nullptr, no_filter, {}}}};

    /// Prepares the ray for its walk, which writes to `best`, or stops at any hit if that is null. Returns ok, or why
    /// it needs no walk.
    QueryStatus begin(const BlobData& blob, const Ray& ray, RayHit* best) {
        const QueryStatus status = prepare(blob, ray, prepared);
        if (status != QueryStatus::ok) return status;
        query.answer.limit = window_limit(prepared.ray);
        query.answer.volume_bits = 0;
        query.answer.best = best;
        if (best != nullptr) *best = miss_with(QueryStatus::not_found);
        return status;
    }
    void answer(const Ray& ray, const BatchAnswers& answers, std::size_t number) const {
        const bool is_found = query.answer.found();
        if (answers.any_will_do()) answers.occluded[number] = YesNo::of(is_found);
        else if (is_found) query.answer.finish(prepared.ray, ray);
    }
};

/// A ray that takes turns with others: the closest hit.
template <class Leaf>
struct ClosestInTurns : RayInBatch<Leaf> {
    using Node = typename Leaf::Node;

    NearestFirst<PlaceOf<Leaf>, RayQuery<Leaf, BatchHit>> walk;

    QueryStatus begin(const BlobData& blob, const Ray& ray, RayHit* best) {
        walk.begin(0);
        return RayInBatch<Leaf>::begin(blob, ray, best);
    }
    ESPALIER_ALWAYS_INLINE bool advance(const BlobData& blob, unsigned mask) {
        return walk.advance(blob, this->query, mask);
    }
};

/// A ray in turns that only looks for any hit.
template <class Leaf>
struct AnyInTurns {
    using Node = typename Leaf::Node;

    PreparedRayIn<RayLanesOf<Node>> prepared = {};
    RayQuery<Leaf, AnyHit> query = {{prepared.ray, prepared.lanes()}, {}};
    StorageOrder<PlaceOf<Leaf>, RayQuery<Leaf, AnyHit>> walk;
    bool found;

    QueryStatus begin(const BlobData& blob, const Ray& ray, RayHit*) {
        walk.begin();
        const QueryStatus status = prepare(blob, ray, prepared);
        if (status == QueryStatus::ok) query.answer.limit = window_limit(prepared.ray);
        return status;
    }
    ESPALIER_ALWAYS_INLINE bool advance(const BlobData& blob, unsigned mask) {
        const Step step = walk.advance(blob, query, mask);
        found = step == Step::was_stopped;
        return step == Step::goes_on;
    }
    void answer(const Ray&, const BatchAnswers& answers, std::size_t number) const {
        answers.occluded[number] = YesNo::of(found);
    }
};

inline constexpr unsigned rays_in_group = 16;
using GroupMask = std::uint32_t;  ///< a bit for each ray

/// Calls the function with the number of each set bit.
template <class Mask, class Function>
inline void for_each_bit(Mask mask, Function function) {
    for (; mask != 0; mask &= mask - 1) function(static_cast<unsigned>(std::countr_zero(mask)));
}

template <class Leaf>
class RayGroup {
public:
    /// Answers rays_in_group rays.
    void answer(const BlobData& blob, const Ray* worlds, const BatchAnswers& answers) {
        GroupMask begun = 0;
        for (unsigned number = 0; number < rays_in_group; ++number) {
            const QueryStatus status = rays_[number].begin(blob, worlds[number], answers.hit(number));
            if (status == QueryStatus::ok) begun |= GroupMask{1} << number;
            else answers.miss(number, status);
        }
        if (begun != 0) walk(blob, begun);
        for_each_bit(begun, [&](unsigned number) { rays_[number].answer(worlds[number], answers, number); });
    }

private:
    struct Waiting {
        std::uint64_t entry;  ///< the smallest key of its rays above the index, as in NearestFirst
        GroupMask rays;
    };

    void walk(const BlobData& blob, GroupMask rays) {
        size_ = 0;
        std::uint32_t index = 0;
        for (;;) {
            if ((rays & (rays - 1)) == 0)  // alone: the rest of its way is walked without the others
                traverse_nearest_first<PlaceOf<Leaf>>(blob, rays_[std::countr_zero(rays)].query, index);
            else visit(blob, node_at<typename Leaf::Node>(blob, index), rays);
            do {
                if (size_ == 0) return;
                const Waiting& next = stack_[--size_];
                rays = still_interested(next.rays, [&](unsigned) {
                    return std::bit_cast<float>(static_cast<std::uint32_t>(next.entry >> 32));
                });
                index = static_cast<std::uint32_t>(next.entry);
            } while (rays == 0);
        }
    }

    /// Those of the rays whose limit is not below their key.
    template <class KeyOf>
    GroupMask still_interested(GroupMask rays, KeyOf key_of) const {
        GroupMask result = 0;
        for_each_bit(rays, [&](unsigned number) {
            result |= static_cast<GroupMask>(key_of(number) <= rays_[number].query.limit()) << number;
        });
        return result;
    }

    void visit(const BlobData& blob, const typename Leaf::Node& node, GroupMask rays) {
        GroupMask by_child[Leaf::Node::max_children] = {};
        for_each_bit(rays, [&](unsigned number) {
            count_node_step();
            for_each_bit(rays_[number].query.children(node, keys_[number]),
                         [&](unsigned child) { by_child[child] |= GroupMask{1} << number; });
        });
        const auto rays_of = [&](unsigned child) {
            return still_interested(by_child[child], [&](unsigned number) { return keys_[number][child]; });
        };
        const unsigned node_children = node.node_children();
        for (unsigned number = 0; number < node.leaf_children(); ++number)
            if (const GroupMask those = rays_of(node_children + number); those != 0)
                visit_leaf({&blob, node, number}, those);
        const unsigned bottom = size_;
        // mutant(!= -> true) work: stores a child that no ray needs, which is dropped later
        for (unsigned child = 0; child < node_children; ++child)
            if (const GroupMask those = rays_of(child); those != 0) put_aside(blob, node, child, those, bottom);
    }

    /// On the stack, the nearer ones on top.
    void put_aside(const BlobData& blob, const typename Leaf::Node& node, unsigned child, GroupMask rays,
                   unsigned bottom) {
        std::uint32_t key = infinity_bits;
        for_each_bit(rays, [&](unsigned number) {
            const auto own = std::bit_cast<std::uint32_t>(keys_[number][child]);
            // mutant(< -> <=) equivalent: both sides are equal then
            key = own < key ? own : key;
        });
        const std::uint32_t index = node.first_child() + child;
        prefetch(node_at<typename Leaf::Node>(blob, index).bytes);
        const Waiting waits = {std::uint64_t{key} << 32 | index, rays};
        unsigned place = size_++;
        // mutant(< -> <=) equivalent: no two entries are equal, since each contains the number of its node
        for (; place > bottom && stack_[place - 1].entry < waits.entry; --place) stack_[place] = stack_[place - 1];
        stack_[place] = waits;
    }

    /// First what lanes can reject, for all rays, then the rest in integers: so the branches come together.
    void visit_leaf(const PlaceOf<Leaf>& place, GroupMask rays) {
        count_leaf_step();
        UnpackedLeaf<Leaf> leaf;
        decode_leaf(*place.blob, place.node, place.number, leaf);
        typename Leaf::Slots candidates[rays_in_group];
        const GroupMask with_candidates = with_table_groups<Leaf::max_vertices>(
            leaf.vertex_count, [&](auto groups) { return reject<groups>(leaf, rays, candidates); });
        for_each_bit(with_candidates, [&](unsigned number) {
            for_each_bit(candidates[number], [&](unsigned slot) {
                rays_[number].query.answer.decide(rays_[number].prepared.ray, leaf, slot);
            });
        });
    }

    /// ray_candidates, for several rays. Those who have any.
    template <unsigned groups>
    GroupMask reject(UnpackedLeaf<Leaf>& leaf, GroupMask rays, typename Leaf::Slots* candidates) const {
        constexpr unsigned slots = 8 * sizeof(typename Leaf::Slots);
        CornerNumbers numbers[(slots + lanes - 1) / lanes];
        const unsigned used = SeenVertices<groups>::groups_of(leaf.vertex_count);
        leaf.unpack_vertices(used);
        auto corners = leaf.corners_in_lanes();
        // mutant(< -> <=) sanitizer: reads or writes behind an array, where a later value belongs
        for (unsigned first = 0; first < leaf.slot_count; first += lanes) numbers[first / lanes] = corners.next();
        GroupMask result = 0;
        for_each_bit(rays, [&](unsigned number) {
            const LatticeRay& ray = rays_[number].prepared.ray;
            SeenVertices<groups> vertices(leaf, ray);
            see_vertices<groups>(leaf, ray, used, vertices);
            typename Leaf::Slots mask = 0;
            // mutant(< -> <=) sanitizer: shifts by the width of the type where a leaf is full
            for (unsigned first = 0; first < leaf.slot_count; first += lanes)
                mask |= typename Leaf::Slots{vertices.allow(numbers[first / lanes])} << first;
            candidates[number] = mask & leaf.used_slots();
            // mutant(!= -> true) equivalent: a ray without candidates has nothing to visit
            result |= static_cast<GroupMask>(candidates[number] != 0) << number;
        });
        return result;
    }

    RayInBatch<Leaf> rays_[rays_in_group];
    Waiting stack_[(format::max_depth - 1) * (Leaf::Node::max_children - 1) + 1];  ///< enough as in NearestFirst
    unsigned size_ = 0;
    alignas(32) float keys_[rays_in_group][Leaf::Node::max_children];  ///< of the node at hand, by ray
};

/// For whole groups of rays.
template <class Leaf>
ESPALIER_NOINLINE inline void answer_in_groups(const BlobData& blob, const Ray* rays, const BatchAnswers& answers,
                                               std::size_t count) {
    RayGroup<Leaf> group;
    for (std::size_t first = 0; first < count; first += rays_in_group)
        group.answer(blob, rays + first, answers.from(first));
}

ESPALIER_END_SET

#endif
