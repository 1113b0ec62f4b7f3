// The walks through a tree for queries that need no lanes: one of each for all of them where code is dearer than time,
// which calls its visitor by pointers; elsewhere a copy for each visitor.
#pragma once

#include <bit>

#include <espalier/function_ref.hpp>
#include <runtime/simd/lanes_scalar.hpp>
#include <runtime/small_code.hpp>
#include <runtime/step_counter.hpp>

namespace espalier::detail::scalar_walk {

namespace own_copy {
#include <runtime/traverse.inl>
}  // namespace own_copy

using own_copy::with_leaf;
using own_copy::with_leaves_of;

/// Any visitor over leaves of that kind.
template <class Leaf>
struct AnyVisitor {
    void* visitor;
    using Node = typename Leaf::Node;

    unsigned (*children_of)(void*, const Node&, float*);
    Visit (*visit)(void*, const Leaf&);
    float (*limit_of)(const void*);

    unsigned children(const Node& node, float* keys) { return children_of(visitor, node, keys); }
    Visit visit_leaf(const Leaf& leaf) { return visit(visitor, leaf); }
    [[nodiscard]] float limit() const { return limit_of(visitor); }
};
template <class Leaf, class Visitor>
AnyVisitor<Leaf> any_visitor(Visitor& visitor) {
    return {&visitor,
            [](void* self, const typename Leaf::Node& node, float* keys) {
                return static_cast<Visitor*>(self)->children(node, keys);
            },
            [](void* self, const Leaf& leaf) { return static_cast<Visitor*>(self)->visit_leaf(leaf); },
            [](const void* self) {
                if constexpr (requires { static_cast<const Visitor*>(self)->limit(); })
                    return static_cast<const Visitor*>(self)->limit();
                else return infinity;
            }};
}

template <class Leaf>
[[gnu::noinline]] void traverse_any_nearest_first(const BlobData& blob, AnyVisitor<Leaf>& visitor) {
    own_copy::traverse_nearest_first<Leaf>(blob, visitor);
}

/// As in traverse.inl.
template <class Leaf, class Visitor>
inline Visit traverse_in_storage_order(const BlobData& blob, Visitor& visitor) {
    if constexpr (small_code) {
        AnyVisitor<Leaf> any = any_visitor<Leaf>(visitor);
        return own_copy::traverse_in_storage_order<Leaf>(blob, any);
    } else {
        return own_copy::traverse_in_storage_order<Leaf>(blob, visitor);
    }
}
template <class Leaf, class Visitor>
inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor) {
    if constexpr (small_code) {
        AnyVisitor<Leaf> any = any_visitor<Leaf>(visitor);
        traverse_any_nearest_first(blob, any);
    } else {
        own_copy::traverse_nearest_first<Leaf>(blob, visitor);
    }
}

/// Calls visit(slot, triangle) for the triangles of a leaf in turn, until one of them answers stop.
template <class Leaf, class OnTriangle>
inline Visit visit_triangles_of(const Leaf& leaf, OnTriangle visit) {
    for (auto slots = leaf.used_slots(); slots != 0; slots &= slots - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(slots));
        if (visit(slot, leaf.triangle(slot)) == stop) return stop;
    }
    return keep_going;
}
using OnTriangle = FunctionRef<Visit(unsigned, const LatticeTriangle&)>;
template <class Leaf>
[[gnu::noinline]] Visit visit_any_triangles_of(const Leaf& leaf, OnTriangle visit) {
    return visit_triangles_of(leaf, visit);
}
template <class Leaf, class Function>
inline Visit for_each_triangle_of(const Leaf& leaf, Function visit) {
    if constexpr (small_code) return visit_any_triangles_of(leaf, OnTriangle(visit));
    else return visit_triangles_of(leaf, visit);
}

}  // namespace espalier::detail::scalar_walk
