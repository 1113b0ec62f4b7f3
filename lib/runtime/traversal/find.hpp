// Runs a query by the walk that suits its answer. The names of walks are in parentheses, so that argument-dependent
// lookup does not find one in the namespace of the shape.
#ifndef ESPALIER_TRAVERSAL_FIND_HPP
#define ESPALIER_TRAVERSAL_FIND_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/query.hpp>

ESPALIER_BEGIN_SET

/// Any visitor over leaves of that kind, called by pointers.
template <class Leaf>
class AnyVisitor {
public:
    using Node = typename Leaf::Node;
    struct CostlyLeaves {};

    template <class Visitor>
    explicit AnyVisitor(Visitor& visitor)
        : visitor_(&visitor),
          children_([](void* self, const Node& node, float* keys) {
              return static_cast<Visitor*>(self)->children(node, keys);
          }),
          visit_leaf_([](void* self, const Leaf& leaf) { return static_cast<Visitor*>(self)->visit_leaf(leaf); }),
          limit_([](const void* self) {
              if constexpr (requires { static_cast<const Visitor*>(self)->limit(); })
                  return static_cast<const Visitor*>(self)->limit();
              else return infinity;
          }) {}
    unsigned children(const Node& node, float* keys) { return children_(visitor_, node, keys); }
    Visit visit_leaf(const Leaf& leaf) { return visit_leaf_(visitor_, leaf); }
    [[nodiscard]] float limit() const { return limit_(visitor_); }

private:
    void* visitor_;
    unsigned (*children_)(void*, const Node&, float*);
    Visit (*visit_leaf_)(void*, const Leaf&);
    float (*limit_)(const void*);
};

/// How the walks take a visitor: small code has one copy of each walk for all of them.
template <class Leaf, class Visitor>
using AnyInSmallCode = std::conditional_t<small_code, AnyVisitor<Leaf>, Visitor&>;

template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline Visit visit_in_storage_order(const BlobData& blob, Visitor& visitor) {
    AnyInSmallCode<Leaf, Visitor> any(visitor);
    return (traverse_in_storage_order<Leaf>)(blob, any);
}
template <class Leaf, class Visitor>
ESPALIER_SHARED_OR_PART_OF_CALLER inline void walk_nearest_first(const BlobData& blob, Visitor& visitor) {
    (traverse_nearest_first<Leaf>)(blob, visitor);
}
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline void visit_nearest_first(const BlobData& blob, Visitor& visitor) {
    AnyInSmallCode<Leaf, Visitor> any(visitor);
    (walk_nearest_first<Leaf>)(blob, any);
}

/// Calls the function with a query, of no accuracy or of the one that is given.
template <class Function, class Shape, class SomeAnswer>
ESPALIER_ALWAYS_INLINE inline auto with_query(Function function, const BlobData&, Shape& shape, SomeAnswer& answer) {
    Query<Shape&, SomeAnswer&, true> query = {shape, answer};
    return function(query);
}
template <class Function, class Shape, class SomeAnswer>
ESPALIER_ALWAYS_INLINE inline auto with_query(Function function, const BlobData& blob, Shape& shape, SomeAnswer& answer,
                                              const WalkAccuracy& accuracy) {
    if (takes_shortcut(accuracy.is_exact())) return with_query(function, blob, shape, answer);
    Query<Shape&, SomeAnswer&, false> query = {shape, answer, {blob, accuracy}};
    return function(query);
}

/// Triangles in storage order. True when the answer stopped the walk. An accuracy may follow.
template <class Shape, class SomeAnswer, class... GivenAccuracy>
inline bool find_in_order(const BlobData& blob, Shape& shape, SomeAnswer& answer, const GivenAccuracy&... accuracy) {
    return with_leaves_of(blob, [&]<class Leaf>() {
        const auto walk = [&](auto& query) {
            const bool is_stopped = (visit_in_storage_order<Leaf>)(blob, query) == Visit::stop;
            return is_stopped || query.is_over();
        };
        return with_query(walk, blob, shape, answer, accuracy...);
    });
}

/// Triangles in storage order, each once. True when the answer stopped the walk. The shape takes the answer as
/// SomeAnswer.
template <class SomeAnswer, class Shape>
inline bool find_each(const BlobData& blob, Shape& shape, Each& answer, const WalkAccuracy& accuracy) {
    auto& some_answer = static_cast<SomeAnswer&>(answer);
    [[maybe_unused]] const auto reached = [&](const PlainNode& node, unsigned children) {
        Shape again = shape;  // the walk's own may remember a node
        alignas(register_alignment) float keys[PlainNode::max_children];
        return again.cull(node, answer.limit, keys) & children;
    };
    if constexpr (reads_duplicate_references) answer.reached = reached;
    return find_in_order(blob, shape, some_answer, accuracy);
}

/// The nearest first.
template <class Leaf, class Shape, class SomeAnswer, class... GivenAccuracy>
inline void find_nearest_first_in(const BlobData& blob, Shape& shape, SomeAnswer& answer,
                                  const GivenAccuracy&... accuracy) {
    const auto walk = [&](auto& query) { (visit_nearest_first<Leaf>)(blob, query); };
    with_query(walk, blob, shape, answer, accuracy...);
}
template <class Shape, class SomeAnswer, class... GivenAccuracy>
inline void find_nearest_first(const BlobData& blob, Shape& shape, SomeAnswer& answer,
                               const GivenAccuracy&... accuracy) {
    with_leaves_of(blob, [&]<class Leaf>() { find_nearest_first_in<Leaf>(blob, shape, answer, accuracy...); });
}

/// The triangles of a leaf that a shape may overlap as far as lanes tell, and those that it surely overlaps.
template <class Slots>
struct OverlapCandidates {
    Slots near = 0;
    Slots sure = 0;
};
/// Hands the answer those that overlap; `overlaps(slot)` decides on one.
template <class Leaf, class SomeAnswer, class Overlaps>
ESPALIER_ALWAYS_INLINE inline Visit take_candidates(const Leaf& leaf,
                                                    OverlapCandidates<typename Leaf::Slots> candidates,
                                                    SomeAnswer& answer, Overlaps overlaps) {
    for (; candidates.near != 0; candidates.near &= candidates.near - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(candidates.near));
        const std::uint32_t reference = storage_index(leaf, slot);
        if (reference < answer.first) continue;
        if ((candidates.sure >> slot & 1u) == 0 && !overlaps(slot)) continue;
        if (answer.take(found_at(leaf, reference), leaf, slot) == Visit::stop) return Visit::stop;
    }
    return Visit::next;
}

ESPALIER_END_SET

#endif
