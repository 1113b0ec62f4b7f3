// A first look at a few pairs of leaves that are likely to be near each other: the distance and the direction that they
// tell spare the walk most of its steps.
#ifndef ESPALIER_PAIRS_BEAM_HPP
#define ESPALIER_PAIRS_BEAM_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/pairs/walk.hpp>

ESPALIER_BEGIN_SET

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

    /// Inserts a candidate behind those with a smaller or an equal key.
    void offer(const Candidate& candidate) {
        unsigned place = count_;
        // mutant(< -> <=) work: changes which of two equally near pairs comes first
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
inline void offer_children(const PairFrame& frame, const Visitor& visitor, const Beam::Candidate& candidate,
                           Beam& next) {
    alignas(wide_register_alignment) float keys[format::max_children];
    const OpenedBox opened =
        open_larger(frame, visitor, PairOfBoxes(frame, candidate.items[0], candidate.items[1]), keys);
    const float unit = frame.sides[opened.side].common_size;
    for (unsigned mask = opened.children; mask != 0; mask &= mask - 1) {
        const auto child = static_cast<unsigned>(std::countr_zero(mask));
        Beam::Candidate below = candidate;
        below.items[opened.side] = child_of(frame, opened.side, opened.node, child);
        below.key = keys[child] * (unit * unit);
        next.offer(below);
    }
}

/// Where the way down ends. More pairs of leaves tell less than they cost.
struct PromisingLeaves {
    static constexpr unsigned most = 2;

    PairItem items[most][2];
    unsigned count = 0;
};

/// Down both trees at once, at each step with no more than the `width` most promising pairs (beam search, Lowerre
/// 1976). Out of line: what this takes of the stack is not needed beside the leaves.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus find_promising(const PairFrame& frame, const Visitor& visitor, unsigned width,
                                             std::uint64_t& work, PromisingLeaves& leaves) {
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
            offer_children(frame, visitor, candidate, next);
        }
        beam = next;
    }
    for (const auto& [items, key] : beam) {
        if (leaves.count == PromisingLeaves::most) break;
        leaves.items[leaves.count][0] = items[0];
        leaves.items[leaves.count++][1] = items[1];
    }
    return QueryStatus::ok;
}

/// Visits the leaves that such a way leads to. Visitor and `work` are those of walk_pair.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus visit_promising(const PairFrame& frame, Visitor& visitor, unsigned width,
                                              std::uint64_t& work) {
    PromisingLeaves leaves;
    if (find_promising(frame, visitor, width, work, leaves) != QueryStatus::ok) return QueryStatus::work_limit;
    for (unsigned i = 0; i < leaves.count; ++i) {
        if (work == 0) return QueryStatus::work_limit;
        --work;
        if (visit_leaf_pair(frame, visitor, PairOfBoxes(frame, leaves.items[i][0], leaves.items[i][1])) == Visit::stop)
            break;
    }
    return QueryStatus::ok;
}

/// A first look, then the walk. Out of line: a search for contacts does not need what this takes of the stack.
template <class Visitor>
ESPALIER_NOINLINE QueryStatus search_nearest(const PairFrame& frame, Visitor& visitor, LeastDistance& least,
                                             std::uint64_t& work) {
    QueryStatus status = QueryStatus::ok;
    const auto goes_on = [&] { return status == QueryStatus::ok && !least.is_done(); };
    // Width 1 comes first, because within_distance() often ends with the first pair that is found.
    for (const unsigned width : {1u, Beam::most_width})
        if (goes_on()) status = visit_promising(frame, visitor, width, work);
    least.surveys = false;
    if (goes_on()) status = walk_pair(frame, visitor, nullptr, work);
    if (least.found && least.best.distance.squared == 0.0f)
        least.best.distance = distance_between(least.best.a, least.best.b);  // and where
    return status;
}

ESPALIER_END_SET

#endif
