#include <runtime/moving_scenes/pairs.hpp>

#include <runtime/moving_scenes/box_tree/slots.hpp>

namespace espalier::detail {

namespace {

InstancePair sorted_pair(std::uint32_t a, std::uint32_t b) { return a < b ? InstancePair{a, b} : InstancePair{b, a}; }

/// Sorts pairs by their lower slots in place; counts[a] is how many pairs have a, and is overwritten.
void sort_by_lower_slot(std::span<InstancePair> pairs, std::uint32_t* counts, std::uint32_t slots) {
    std::uint32_t sum = 0;
    for (std::uint32_t a = 0; a < slots; ++a) counts[a] = sum += counts[a];
    // Each pair goes to the end of what is left of its range; what lies before the place at hand is in order.
    for (std::size_t i = 0; i < pairs.size();) {
        std::uint32_t& end = counts[pairs[i].a];
        if (i >= end) {
            ++i;
            continue;
        }
        --end;
        const InstancePair other = pairs[end];
        pairs[end] = pairs[i];
        pairs[i] = other;
    }
}

void sort_by_insertion(std::span<InstancePair> pairs) {
    for (std::size_t i = 1; i < pairs.size(); ++i) {
        const InstancePair pair = pairs[i];
        std::size_t at = i;
        for (; at > 0 && pair < pairs[at - 1]; --at) pairs[at] = pairs[at - 1];
        pairs[at] = pair;
    }
}

/// Moves the pair at a place of a heap down until none below it is greater.
void sift_down(std::span<InstancePair> heap, std::size_t at) {
    const InstancePair pair = heap[at];
    for (std::size_t child = 2 * at + 1; child < heap.size(); child = 2 * at + 1) {
        if (child + 1 < heap.size() && heap[child] < heap[child + 1]) ++child;
        if (!(pair < heap[child])) break;
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = pair;
}
void sort_by_heap(std::span<InstancePair> pairs) {
    for (std::size_t i = pairs.size() / 2; i-- > 0;) sift_down(pairs, i);
    for (std::size_t size = pairs.size(); size > 1; --size) {
        const InstancePair greatest = pairs[0];
        pairs[0] = pairs[size - 1];
        pairs[size - 1] = greatest;
        sift_down(pairs.first(size - 1), 0);
    }
}

/// Sorts the pairs of each lower slot by the higher one: few of them by insertion, a slot that touches many by a heap.
void sort_by_higher_slot(std::span<InstancePair> pairs) {
    constexpr std::size_t few = 32;
    for (std::size_t first = 0; first < pairs.size();) {
        std::size_t end = first + 1;
        while (end < pairs.size() && pairs[end].a == pairs[first].a) ++end;
        const std::span<InstancePair> of_slot = pairs.subspan(first, end - first);
        if (of_slot.size() <= few) sort_by_insertion(of_slot);
        else sort_by_heap(of_slot);
        first = end;
    }
}

/// The search for the pairs of a page: visits those that count, as often as it is needed.
class PairWalk {
public:
    PairWalk(SceneBlock& block, const PairFilter& filter, InstancePair from, SelfJoin join)
        : block_(block),
          filter_(filter),
          from_(from),
          join_(join),
          starts_at_moved_(filter.only_moved && are_few_moved()) {}

    template <class Visit>
    void for_each(Visit visit) const {
        const auto pass_on = [&](std::uint32_t x, std::uint32_t y) {
            const InstancePair pair = sorted_pair(x, y);
            if (pair >= from_ && is_selected(block_, filter_, pair)) visit(pair);
        };
        if (starts_at_moved_) {
            join_(block_, true, [&](std::uint32_t moved, std::uint32_t other) {
                // Two that have moved are met twice.
                if (moved < other || !has_moved(block_, other)) pass_on(moved, other);
            });
        } else if (filter_.only_moved) {
            join_(block_, false, [&](std::uint32_t x, std::uint32_t y) {
                if (has_moved(block_, x) || has_moved(block_, y)) pass_on(x, y);
            });
        } else {
            join_(block_, false, pass_on);
        }
    }

private:
    /// Returns whether a walk for those that have moved takes less than one for all.
    [[nodiscard]] bool are_few_moved() const {
        std::uint32_t count = 0;
        for (std::uint32_t slot = 0; slot < block_.head->slots_used; ++slot) count += has_moved(block_, slot) ? 1u : 0u;
        return count < block_.head->live / 4;
    }
    SceneBlock& block_;
    const PairFilter& filter_;
    InstancePair from_;
    SelfJoin join_;
    bool starts_at_moved_;
};

/// Writes the pairs of one slot that has more of them than there is room for.
FilledPairs<InstancePair> collect_of_slot(SceneBlock& block, const PairWalk& walk, std::span<InstancePair> out,
                                          InstancePair from) {
    const std::uint32_t slots = block.head->slots_used;
    for (std::uint32_t b = 0; b < slots; ++b) block.counts[b] = 0;
    walk.for_each([&](const InstancePair& pair) {
        if (pair.a == from.a) block.counts[pair.b] = 1;
    });
    FilledPairs<InstancePair> page = {0, from, QueryStatus::output_full};
    for (std::uint32_t b = 0; b < slots; ++b) {
        if (block.counts[b] == 0) continue;
        page.next = {from.a, b};
        if (page.count == out.size()) break;
        out[page.count++] = {from.a, b};
    }
    return page;
}

}  // namespace

FilledPairs<InstancePair> collect_touching_pairs(SceneBlock& block, std::span<InstancePair> out,
                                                 const PairFilter& filter, InstancePair from, SelfJoin join) {
    const PairWalk walk(block, filter, from, join);
    const std::uint32_t slots = block.head->slots_used;
    std::uint32_t* const counts = block.counts;
    for (std::uint32_t a = 0; a < slots; ++a) counts[a] = 0;
    std::uint64_t found = 0;
    walk.for_each([&](const InstancePair& pair) {
        ++counts[pair.a];
        if (found < out.size()) out[static_cast<std::size_t>(found)] = pair;
        ++found;
    });
    FilledPairs<InstancePair> page = {static_cast<std::size_t>(found), {slots, 0}, QueryStatus::ok};
    if (found > out.size()) {
        // The lower slots whose pairs fit in.
        std::uint32_t end = 0;
        for (page.count = 0; page.count + counts[end] <= out.size(); ++end) page.count += counts[end];
        page.next = {end, end == from.a ? from.b : 0};
        page.status = QueryStatus::output_full;
        if (page.count == 0) return collect_of_slot(block, walk, out, page.next);
        for (std::uint32_t a = end; a < slots; ++a) counts[a] = 0;
        std::size_t at = 0;
        walk.for_each([&](const InstancePair& pair) {
            if (pair.a < end) out[at++] = pair;
        });
    }
    const std::span<InstancePair> pairs = out.first(page.count);
    sort_by_lower_slot(pairs, counts, slots);
    sort_by_higher_slot(pairs);
    return page;
}

}  // namespace espalier::detail
