// The walk through two trees at once. At each step the larger of two boxes is replaced by those of its node's children
// that are worth a visit. A visitor offers:
//   unsigned children(unsigned side, const Node&, const TwiceBox& other, float* keys)
//       mask of the children of a node of tree `side` that are worth a visit beside a box of the other tree, and for
//       each how near it is: the nearest goes first, the others in storage order
//   Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box)      stop ends the walk
#ifndef ESPALIER_PAIRS_WALK_HPP
#define ESPALIER_PAIRS_WALK_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/stacks.hpp>

ESPALIER_BEGIN_SET

/// From two boxes to the nearest that one of them is replaced by. False when there is none.
template <class Visitor>
ESPALIER_SHARED_CODE inline bool step_down(const PairFrame& frame, const Visitor& visitor, PairOfBoxes& at,
                                           PairStack& stack) {
    alignas(wide_register_alignment) float keys[format::max_children];
    const OpenedBox opened = open_larger(frame, visitor, at, keys);
    if (opened.children == 0) return false;
    const unsigned best = nearest_child(opened.children, keys);
    stack.push(opened, best, opened.children & ~(1u << best), at);
    at.set(frame, opened.side, child_of(frame, opened.side, opened.node, best));
    return true;
}

/// The way that a walk takes to the two leaves that hold a pair of triangles. invalid_argument if no walk comes there.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus find_leaves_of(const TrianglePair& pair, const PairFrame& frame, const Visitor& visitor,
                                             PairOfBoxes& at, PairStack& stack, std::uint64_t& work) {
    while (!at.are_leaves()) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        alignas(wide_register_alignment) float keys[format::max_children];
        const OpenedBox opened = open_larger(frame, visitor, at, keys);
        const TriangleId triangle = opened.side == 0 ? pair.a : pair.b;
        const unsigned child = child_holding(frame.blob(opened.side), opened.node, triangle.index);
        if ((opened.children >> child & 1u) == 0) return QueryStatus::invalid_argument;
        stack.push(opened, child, children_after(child, opened.children, keys), at);
        at.set(frame, opened.side, child_of(frame, opened.side, opened.node, child));
    }
    return QueryStatus::ok;
}

/// From the roots on, or from the leaves that hold a pair of triangles. `work` is how many pairs of boxes may be
/// visited, and then how many are left.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus walk_pair(const PairFrame& frame, Visitor& visitor, const TrianglePair* from,
                                        std::uint64_t& work) {
    PairStack stack;
    PairOfBoxes at(frame, {}, {});
    if (from != nullptr) {
        const QueryStatus status = find_leaves_of(*from, frame, visitor, at, stack, work);
        if (status != QueryStatus::ok) return status;
    }
    for (;;) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        if (!at.are_leaves()) {
            if (step_down(frame, visitor, at, stack)) continue;
        } else if (visit_leaf_pair(frame, visitor, at) == Visit::stop) {
            return QueryStatus::ok;
        }
        if (!stack.take_waiting(frame, at)) return QueryStatus::ok;
    }
}

ESPALIER_END_SET

#endif
