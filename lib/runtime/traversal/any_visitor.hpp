// Visitors of a walk by pointers: small code has one copy of each walk for all of them.
#pragma once

#include <type_traits>

#include <runtime/answers/answer.hpp>
#include <runtime/base/options.hpp>

namespace espalier::detail {

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

}  // namespace espalier::detail
