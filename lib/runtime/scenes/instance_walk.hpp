// The walks over the instances of a scene, and what a query does at each of them.
#pragma once

#include <espalier/base/function_ref.hpp>
#include <espalier/scene.hpp>
#include <runtime/answers/answer.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/scenes/box_in_steps.hpp>
#include <runtime/scenes/instances.hpp>
#include <runtime/scenes/passage.hpp>

namespace espalier::detail {

/// An instance that a walk visits, with what a query needs of it.
struct VisitedInstance : MeshOrTile {
    InstanceId id;
    Transform transform;
    bool is_rounded = false;  ///< its translation, for the view of a MovingScene

    /// Returns the id of what a query of the instance has found.
    [[nodiscard]] InstanceId id_of(InstanceId in_tile) const { return {id.index, in_tile.index}; }
};

/// A visitor of an instance and of the walk's limit, which it may lower. Stop ends a walk in order.
using InstanceVisitor = FunctionRef<Visit(const VisitedInstance&, float&)>;

/// An answer that passes the leaves of a walk to a visitor: instances whose mask shares a bit with the given one, and
/// whose boxes meet `meeting` if there is one.
template <class Visitor>
struct InstanceAnswer {
    const SceneData& scene;
    std::uint32_t mask;
    float limit;
    const Visitor& visit;
    const BoxInSteps* meeting = nullptr;

    ESPALIER_ALWAYS_INLINE Visit take(const InstancePlace& place) {
        if (meeting != nullptr && !meeting->meets_box_of(place)) return Visit::next;
        const InstanceId id = instance_of(place);
        const std::byte* const record = record_of(scene, id);
        if ((mask_of(record) & mask) == 0) return Visit::next;
        return visit({part_of(scene, record), id, transform_of(record)}, limit);
    }
};

/// The answer of the walks that all visitors share.
using AnyInstanceAnswer = InstanceAnswer<InstanceVisitor>;

/// The instances of a moving scene: the same walks over its tree. Only programs with moving scenes link them.
struct MovingInstances {
    void (*nearest_to_passage)(const Passage& passage, AnyInstanceAnswer& answer);
    void (*nearest_to_point)(const RoundedPoint& point, AnyInstanceAnswer& answer);
    Visit (*in_order)(const Passage& passage, AnyInstanceAnswer& answer);
    Transform (*transform_of)(const SceneData& scene, InstanceId instance);
};

/// Returns the transform of an instance, whose number must be below the count.
inline Transform transform_at(const SceneData& scene, InstanceId instance) {
    if (scene.moving != nullptr) return scene.moving->transform_of(scene, instance);
    return transform_of(record_of(scene, instance));
}

/// Visits the instances whose boxes a passage meets up to the limit, or whose boxes are within a squared distance of a
/// point, in steps: the nearest first.
void visit_nearest_instances(const SceneData& scene, std::uint32_t mask, const Passage& passage, float limit,
                             const InstanceVisitor& visit);
void visit_nearest_instances(const SceneData& scene, std::uint32_t mask, const RoundedPoint& point, float limit,
                             const InstanceVisitor& visit);

/// Visits those whose boxes a passage meets, and `meeting` if there is one, in ascending order. Returns stop if the
/// visitor does.
Visit visit_instances(const SceneData& scene, std::uint32_t mask, const Passage& passage, float limit,
                      const InstanceVisitor& visit, const BoxInSteps* meeting = nullptr);

/// Visits those that the box around a shape that stays where it is meets.
Visit visit_meeting(const SceneView& scene, const ShapeBounds& bounds, std::uint32_t mask,
                    const InstanceVisitor& visit);

/// Returns a limit for the query of an instance, a little above the best result so far. A result that is clamped to it
/// is then worse than the best one, and one that is as good is not clamped.
inline float limit_above(float best) { return best * (1.0f + 0x1p-20f) + 0x1p-100f; }

/// The triangles of one instance that a filter keeps, as the filter of a query of its mesh or tile.
struct FilterOfInstance {
    const SceneFilter& filter;
    const VisitedInstance& instance;

    bool operator()(TriangleId triangle) const { return filter.keep()(instance.id, triangle); }
    bool operator()(InstanceId in_tile, TriangleId triangle) const {
        return filter.keep()(instance.id_of(in_tile), triangle);
    }
    /// Returns the filter of a query of a mesh. It refers to this one.
    [[nodiscard]] TriangleFilter of(const Blob&) const {
        return filter.keep() ? TriangleFilter(*this) : TriangleFilter();
    }
    /// Returns the filter of a query of a tile. It refers to this one.
    [[nodiscard]] SceneFilter of(const BakedScene&) const {
        return {filter.mask(), filter.keep() ? SceneTriangleFilter(*this) : SceneTriangleFilter()};
    }
};

/// Returns the status of the query of an instance as that of the scene's query. The arguments are sound: what is
/// refused is out of the range of the instance, also where its local space has no finite number for it.
inline QueryStatus status_in_scene(QueryStatus of_instance) {
    return is_refused(of_instance) ? QueryStatus::out_of_range : of_instance;
}

/// The best result of a query over instances.
template <class Hit>
class BestInScene {
public:
    explicit BestInScene(QueryStatus status) { best_.hit.status = status; }
    explicit BestInScene(const Hit& miss) : best_{miss, {}} {}

    [[nodiscard]] explicit operator bool() const { return static_cast<bool>(best_); }
    [[nodiscard]] const Hit* operator->() const { return &best_.hit; }
    [[nodiscard]] const Hit& operator*() const { return best_.hit; }
    /// Returns whether the result is better: has a lower key, or an equal one and a lower instance. Notes a refusal.
    bool is_better(const Hit& hit, InstanceId instance, float Hit::*key) {
        // By their bits, which order numbers that are not negative, also subnormal ones in any mode.
        return is_better(hit, instance, magnitude_bits(hit.*key), magnitude_bits(best_.hit.*key));
    }
    /// Returns the same for a key of the caller's and that of the best result.
    bool is_better(const Hit& hit, InstanceId instance, std::uint32_t key, std::uint32_t best_key) {
        if (is_refused(hit.status)) refusal_ = status_in_scene(hit.status);
        if (hit.status != QueryStatus::ok) return false;
        return !best_ || key < best_key || (key == best_key && instance < best_.instance);
    }
    void set(const Hit& hit, InstanceId instance) {
        best_.hit = hit;
        best_.instance = instance;
    }
    [[nodiscard]] InScene<Hit> result() const {
        if (refusal_ == QueryStatus::ok) return best_;
        InScene<Hit> refused;
        refused.hit.status = refusal_;
        return refused;
    }

private:
    InScene<Hit> best_;
    QueryStatus refusal_ = QueryStatus::ok;
};

/// Returns the result of a mesh or of a tile as that of a tile.
template <class Hit>
InScene<Hit> in_tile(const Hit& hit) {
    return {hit, {}};
}
template <class Hit>
InScene<Hit> in_tile(const InScene<Hit>& hit) {
    return hit;
}

}  // namespace espalier::detail
