// The walks through a tree for queries that need no lanes. Small code has one of each for all of them, which calls its
// visitor by pointers; elsewhere each visitor has a copy.
#pragma once

#include <type_traits>

#include <runtime/answers/answer.hpp>
#include <runtime/base/options.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/traversal/bounded_triangles.hpp>
#include <runtime/traversal/box_nodes.hpp>
#include <runtime/traversal/leaf_triangles.hpp>

namespace espalier::detail::scalar_walk {

using scalar::storage_index;
using scalar::visit_leaf;
using scalar::with_leaf;
using scalar::with_leaves_of;

namespace own_copy {
#include <runtime/traversal/traverse.inl>
}  // namespace own_copy

using own_copy::Keys;

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
/// What a walk calls: small code has one walk for all visitors.
template <class Leaf, class Visitor>
using WalkVisitor = std::conditional_t<small_code, AnyVisitor<Leaf>, Visitor&>;

/// As in traverse.inl.
template <class Leaf, class Visitor>
inline Visit traverse_in_storage_order(const BlobData& blob, Visitor& given) {
    WalkVisitor<Leaf, Visitor> visitor(given);
    return own_copy::traverse_in_storage_order<Leaf>(blob, visitor);
}
template <class Leaf, class Visitor>
ESPALIER_SHARED_CODE inline void traverse_nearest_first_in_own_frame(const BlobData& blob, Visitor& visitor) {
    own_copy::traverse_nearest_first<Leaf>(blob, visitor);
}
template <class Leaf, class Visitor>
inline void traverse_nearest_first(const BlobData& blob, Visitor& given) {
    WalkVisitor<Leaf, Visitor> visitor(given);
    traverse_nearest_first_in_own_frame<Leaf>(blob, visitor);
}

#include <runtime/traversal/find.inl>

}  // namespace espalier::detail::scalar_walk
