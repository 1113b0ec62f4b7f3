// Two blobs: the queries as visitors. Included once per instruction set, inside its namespace.

template <class Function>
inline Visit with_leaf_kinds(const PairFrame& frame, Function function) {
    return with_leaves_of(*frame.a, [&]<class LeafA>() {
        return with_leaves_of(*frame.b, [&]<class LeafB>() { return function.template operator()<LeafA, LeafB>(); });
    });
}

/// Pairs that touch, handed to a callable.
struct TouchingPairs {
    const PairFrame& frame;
    OnTouching visit;

    template <class Node>
    unsigned children(unsigned side, const Node& node, const TwiceBox& other, float* keys) const {
        const PairSide& view = frame.sides[side];
        return children_near<true>(node, side == 0 ? *frame.a : *frame.b, see_box(other, view), view, PairAxes{}, 0.0f,
                                   keys);
    }
    Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box) {
        return with_leaf_kinds(
            frame, [&]<class LeafA, class LeafB>() { return visit_touching<LeafA, LeafB>(frame, a, b, a_box, visit); });
    }
};

QueryStatus touching_pairs(const PairFrame& frame, OnTouching visit, std::uint64_t& work) {
    TouchingPairs visitor = {frame, visit};
    return traverse_pair(frame, visitor, work);
}

/// The pair that is least apart, in lanes.
struct NearestPair : LeastDistance {
    template <class Node>
    unsigned children(unsigned side, const Node& node, const TwiceBox& other, float* keys) const {
        const PairSide& view = frame.sides[side];
        const float unit = view.common_size;
        return children_near<false>(node, side == 0 ? *frame.a : *frame.b, see_box(other, view), view, axes_[side],
                                    limit_ / (unit * unit), keys);
    }
    Visit visit_leaves(PairLeaf a, PairLeaf b, const TwiceBox& a_box) {
        return with_leaf_kinds(
            frame, [&]<class LeafA, class LeafB>() { return visit_near<LeafA, LeafB>(frame, a, b, a_box, *this); });
    }
};

QueryStatus nearest_pair(const PairFrame& frame, float radius, bool any, FoundTriangles& best, bool& found,
                         std::uint64_t& work) {
    NearestPair visitor = {{frame, best, radius, any}};
    const QueryStatus status = search_nearest(frame, visitor, visitor, work);
    found = visitor.found;
    return status;
}
