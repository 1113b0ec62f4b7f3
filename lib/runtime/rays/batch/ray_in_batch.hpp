// A ray of a batch: what it needs while others are on their way too.
#ifndef ESPALIER_RAYS_BATCH_RAY_IN_BATCH_HPP
#define ESPALIER_RAYS_BATCH_RAY_IN_BATCH_HPP

#include <runtime/kernels/crossing.hpp>
#include <runtime/lanes/set.hpp>
#include <runtime/rays/batch/batch.hpp>
#include <runtime/rays/closest.hpp>
#include <runtime/rays/in_order.hpp>
#include <runtime/rays/queries.hpp>

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
    RayQuery<Leaf, BatchHit> query = {{prepared.ray, prepared.lanes()}, {{nullptr, nullptr, {}}}};

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

ESPALIER_END_SET

#endif
