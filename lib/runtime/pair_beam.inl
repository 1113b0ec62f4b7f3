// A first look at a few pairs of leaves that are likely to be near each other: the distance and the direction that they
// tell spare the walk most of its steps. Included once per instruction set, inside its namespace, after
// traverse_pair.inl.

/// Pairs of boxes, the most promising first; of those that were offered, as many as it is wide.
class Beam {
public:
    static constexpr unsigned most_width = 8;
    struct Candidate {
        PairItem items[2];
        float key = 0.0f;  ///< the less, the more promising

        [[nodiscard]] bool is_of_leaves() const { return items[0].is_leaf() && items[1].is_leaf(); }
    };

    explicit Beam(unsigned width) : width_(width) {}
    [[nodiscard]] const Candidate* begin() const { return candidates_; }
    [[nodiscard]] const Candidate* end() const { return candidates_ + count_; }

    /// Of equal keys the one that was offered first comes first.
    void offer(const Candidate& candidate) {
        unsigned place = count_;
        for (; place > 0 && candidate.key < candidates_[place - 1].key; --place)
            candidates_[place] = candidates_[place - 1];
        candidates_[place] = candidate;
        if (count_ < width_) ++count_;
    }

private:
    Candidate candidates_[most_width + 1];  ///< one place is for what drops out
    unsigned count_ = 0;
    unsigned width_;
};

/// What a pair of boxes leads to: the children that the visitor finds worth a visit.
template <class Visitor>
inline void offer_children(const PairFrame& frame, const PairTrees& trees, const Visitor& visitor,
                           const Beam::Candidate& candidate, Beam& next) {
    const TwiceBox boxes[2] = {trees.box(0, candidate.items[0]), trees.box(1, candidate.items[1])};
    const unsigned side = trees.side_to_open(candidate.items, boxes);
    const std::uint32_t node = trees.node_in(side, candidate.items[side]);
    alignas(wide_register_alignment) float keys[format::max_children];
    count_node_step();
    unsigned mask = visitor.children(side, node_at(*trees.blob[side], node), boxes[1 - side], keys);
    const float unit = frame.sides[side].common_size;
    for (; mask != 0; mask &= mask - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(mask));
        Beam::Candidate below = candidate;
        below.items[side] = trees.child_of(side, node, child);
        below.key = keys[child] * (unit * unit);
        next.offer(below);
    }
}

/// How many pairs of leaves are visited where the way down ends: more of them tell less than they cost.
inline constexpr unsigned most_leaf_pairs = 2;

/// Down both trees at once, at each step with no more than the `width` most promising pairs (beam search, Lowerre
/// 1976), to visit leaves where that ends. Visitor and `work` are those of traverse_pair.
template <class Visitor>
[[gnu::noinline]] QueryStatus visit_promising(const PairFrame& frame, Visitor& visitor, unsigned width,
                                              std::uint64_t& work) {
    const PairTrees trees(frame);
    Beam beam(width);
    beam.offer({});
    for (bool are_all_leaves = false; !are_all_leaves;) {
        are_all_leaves = true;
        Beam next(width);
        for (const Beam::Candidate& candidate : beam) {
            if (candidate.is_of_leaves()) {
                next.offer(candidate);
                continue;
            }
            if (work == 0) return QueryStatus::work_limit;
            --work;
            are_all_leaves = false;
            offer_children(frame, trees, visitor, candidate, next);
        }
        beam = next;
    }
    unsigned visits = 0;
    for (const auto& [items, key] : beam) {
        if (visits++ == most_leaf_pairs) break;
        if (work == 0) return QueryStatus::work_limit;
        --work;
        count_leaf_step();
        if (visitor.visit_leaves(trees.leaf(0, items[0], trees.box(0, items[0])),
                                 trees.leaf(1, items[1], trees.box(1, items[1]))) == stop)
            break;
    }
    return QueryStatus::ok;
}
