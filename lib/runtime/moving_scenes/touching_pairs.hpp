// Pairs of instances whose boxes touch, in ascending order.
#pragma once

#include <runtime/moving_scenes/box_tree/self_join.hpp>

namespace espalier::detail {

/// A page of pairs that is being filled.
template <class Pair>
struct PairPage {
    std::span<Pair> out;
    FilledPairs<Pair> filled;

    [[nodiscard]] bool is_full() const { return filled.count == out.size(); }
    /// Takes the next pair with the status of a test: ok writes it, not_found leaves it out, any other ends the page
    /// before it.
    Visit take(const Pair& pair, QueryStatus status) {
        if (status == QueryStatus::not_found) return Visit::next;
        if (status == QueryStatus::ok && is_full()) status = QueryStatus::output_full;
        if (status == QueryStatus::ok) {
            out[filled.count++] = pair;
            return Visit::next;
        }
        filled.next = pair;
        filled.status = status;
        return Visit::stop;
    }
};

/// The pairs of live slots whose boxes touch and that a filter selects. They are found with room in the block that is
/// zero before and after, so that questions leave no traces in a snapshot.
class TouchingPairs {
public:
    TouchingPairs(SceneBlock& block, const PairFilter& filter, SelfJoin join)
        : block_(block), filter_(filter), join_(join) {}

    /// Writes all pairs in ascending order, and how many they are. Returns false if there is no room for them. Takes
    /// one walk of the tree against itself, or from all that has moved.
    bool collect_all(std::span<InstancePair> out, std::size_t& count);

    /// Calls `visit(pair)` with each pair from `from` on in ascending order, until it returns stop. Takes a walk of the
    /// tree for each slot, and no room but the block's.
    template <class OnPair>
    void for_each_from(InstancePair from, OnPair visit) {
        for (; from.a < block_.head->slots_used; from = {from.a + 1, 0}) {
            const std::span<const std::uint32_t> others = find_others(from);
            Visit next = Visit::next;
            for (std::size_t i = 0; i < others.size() && next == Visit::next; ++i)
                if (const InstancePair pair = {from.a, others[i]}; is_selected(pair)) next = visit(pair);
            clear_others(others.size());
            if (next == Visit::stop) return;
        }
    }

    /// Returns the pair behind all others.
    [[nodiscard]] InstancePair end() const { return {block_.head->slots_used, 0}; }

private:
    /// Returns the slots above from.a and from from.b on whose boxes touch that of from.a, in ascending order.
    std::span<const std::uint32_t> find_others(InstancePair from);
    void clear_others(std::size_t count);
    [[nodiscard]] bool is_selected(const InstancePair& pair) const;
    [[nodiscard]] bool are_few_moved() const;

    SceneBlock& block_;
    const PairFilter& filter_;
    SelfJoin join_;
};

/// Writes the selected pairs from `from` on, in ascending order, as many as there is room for.
FilledPairs<InstancePair> collect_touching_pairs(SceneBlock& block, std::span<InstancePair> out,
                                                 const PairFilter& filter, InstancePair from,
                                                 SelfJoin join = join_by_best_set);

}  // namespace espalier::detail
