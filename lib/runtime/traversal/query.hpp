// The one query: a walk with a shape and an answer. A shape offers:
//   unsigned cull(const Node&, float limit, float* keys)     mask of the children worth a visit, and for the walk to
//                                                            the nearest first how near each is
//   Visit decide(const Leaf&, unsigned slot, const LatticeTriangle&, SomeAnswer& answer)
//                                                            decides on one triangle, and hands it to answer.take when
//                                                            it is found; returns stop when that does
//   Visit scan(const Leaf&, SomeAnswer& answer)              the same of all triangles of a leaf, most of which it
//                                                            rejects together; without decide, or as well
//   float bound(const LatticeTriangle&, float limit), float tighten(const LatticeTriangle&, float bound, float limit)
//                                                            optional, for walks to the nearest: lower bounds of keys,
//                                                            a quick one and a better one. Triangles are then decided
//                                                            in their order, and decide takes the bound behind the
//                                                            triangle. A bound above the limit need not be exact: any
//                                                            number above the limit will do
//   float farthest(const Node&, unsigned child)              optional: how far the farthest point of a child's box is
//   bool meets_any(blob, const Node&, unsigned children)     optional: whether it meets one of the boxes, exactly
//   struct CostlyLeaves                                      optional: leaves are visited the nearest first, too
#ifndef ESPALIER_TRAVERSAL_QUERY_HPP
#define ESPALIER_TRAVERSAL_QUERY_HPP

#include <runtime/answers/answer.hpp>
#include <runtime/lanes/set.hpp>
#include <runtime/traversal/leaf_triangles.hpp>
#include <runtime/traversal/small_boxes.hpp>
#include <runtime/traversal/traverse.hpp>

ESPALIER_BEGIN_SET

/// What a query needs for an accuracy, and nothing else.
struct Approximation {
    const BlobData& blob;
    const WalkAccuracy& accuracy;
    bool is_over = false;  ///< a small box ended the walk
};
struct NoApproximation {
    NoApproximation() = default;
    NoApproximation(const BlobData&) {}  // NOLINT(google-explicit-constructor): an Approximation has a blob
};

/// Small code has one copy of it.
ESPALIER_SHARED_OR_PART_OF_CALLER inline void count_leaf(QueryCounters& counters, unsigned triangles) {
    counters.count_leaf(triangles);
}

/// Shape and answer may be references.
template <class Shape, class SomeAnswer, bool is_exact>
struct Query {
    Shape shape;
    SomeAnswer answer;
    [[no_unique_address]] std::conditional_t<is_exact, NoApproximation, Approximation> approximation = {};

    [[nodiscard]] auto limit() const { return answer.limit; }
    [[nodiscard]] bool is_over() const {
        if constexpr (is_exact) return false;
        else return approximation.is_over;
    }
    template <class Node>
    ESPALIER_ALWAYS_INLINE unsigned children(const Node& node, Keys keys) {
        if constexpr (is_exact) return shape.cull(node, answer.limit, keys);
        else return children_not_small(node, keys);
    }
    template <class Leaf>
    Visit visit_leaf(const Leaf& leaf) {
        if constexpr (requires { shape.scan(leaf, answer, nullptr); }) {
            QueryCounters* counters = nullptr;
            if constexpr (!is_exact) counters = approximation.accuracy.counters;
            return shape.scan(leaf, answer, counters);
        } else {
            // mutant(without 1, != -> true) equivalent: every leaf ends after 0
            if (answer.first != 0 && storage_index(leaf, 0) + leaf.triangle_count() <= answer.first) return Visit::next;
            if constexpr (!is_exact)
                if (approximation.accuracy.counters != nullptr)
                    count_leaf(*approximation.accuracy.counters, leaf.triangle_count());
            constexpr bool has_scan = requires { shape.scan(leaf, answer); };
            constexpr bool has_bounds_of_triangles = requires(const LatticeTriangle& triangle) {
                shape.bound(triangle, answer.limit);
            };
            constexpr bool has_decide = has_bounds_of_triangles || requires(const LatticeTriangle& triangle) {
                shape.decide(leaf, 0u, triangle, answer);
            };
            // Small code decides triangle by triangle.
            if constexpr (has_scan && !(small_code && has_decide)) return shape.scan(leaf, answer);
            else if constexpr (has_bounds_of_triangles)
                return decide_by_bounds(
                    leaf, answer.limit,
                    [&](const LatticeTriangle& triangle) { return shape.bound(triangle, answer.limit); },
                    [&](const LatticeTriangle& triangle, float bound) {
                        return shape.tighten(triangle, bound, answer.limit);
                    },
                    [&](unsigned slot, const LatticeTriangle& triangle, float bound) {
                        return shape.decide(leaf, slot, triangle, bound, answer);
                    });
            else
                return for_each_triangle_of(leaf, [&](unsigned slot, const LatticeTriangle& triangle) {
                    if (answer.first != 0 && storage_index(leaf, slot) < answer.first) return Visit::next;
                    return shape.decide(leaf, slot, triangle, answer);
                });
        }
    }

private:
    template <class Node, class NodeKeys>
    unsigned children_not_small(const Node& node, NodeKeys keys) {
        const BlobData& blob = approximation.blob;
        const WalkAccuracy& accuracy = approximation.accuracy;
        if (approximation.is_over) return 0;
        if (accuracy.counters != nullptr) accuracy.counters->count_node();
        const unsigned mask = shape.cull(node, answer.limit, keys);
        // mutant(never) work: searches for boxes no longer than a negative length
        if (accuracy.steps < 0) return mask;
        const unsigned small = mask & children_no_larger(node, accuracy.steps, blob.bits);
        if (small == 0) return mask;
        if constexpr (requires { shape.farthest(node, 0u); }) {
            if (answer.on_box != nullptr) {
                for (unsigned left = small; left != 0; left &= left - 1) {
                    const auto child = static_cast<unsigned>(std::countr_zero(left));
                    answer.on_box(answer, keys[child], shape.farthest(node, child));
                }
                return mask & ~small;
            }
        }
        if constexpr (requires { shape.meets_any(blob, node, small); })
            if (!shape.meets_any(blob, node, small)) return mask & ~small;
        approximation.is_over = true;
        return 0;
    }
};

ESPALIER_END_SET

#endif
