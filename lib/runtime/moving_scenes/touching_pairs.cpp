#include <runtime/moving_scenes/touching_pairs.hpp>

namespace espalier::detail {

namespace {

template <class Item>
void sort_by_insertion(std::span<Item> items) {
    for (std::size_t i = 1; i < items.size(); ++i) {
        const Item item = items[i];
        std::size_t at = i;
        for (; at > 0 && item < items[at - 1]; --at) items[at] = items[at - 1];
        items[at] = item;
    }
}

/// Moves the item at a place of a heap down until none below it is greater.
template <class Item>
void sift_down(std::span<Item> heap, std::size_t at) {
    const Item item = heap[at];
    for (std::size_t child = 2 * at + 1; child < heap.size(); child = 2 * at + 1) {
        if (child + 1 < heap.size() && heap[child] < heap[child + 1]) ++child;
        if (!(item < heap[child])) break;
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = item;
}
template <class Item>
void sort_by_heap(std::span<Item> items) {
    for (std::size_t i = items.size() / 2; i-- > 0;) sift_down(items, i);
    for (std::size_t size = items.size(); size > 1; --size) {
        const Item greatest = items[0];
        items[0] = items[size - 1];
        items[size - 1] = greatest;
        sift_down(items.first(size - 1), 0);
    }
}

/// Sorts few items by insertion, and many, of a slot that touches all, by a heap.
template <class Item>
void sort(std::span<Item> items) {
    constexpr std::size_t few = 32;
    if (takes_shortcut(items.size() <= few)) sort_by_insertion(items);
    else sort_by_heap(items);
}

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

/// Sorts the pairs of each lower slot by the higher one.
void sort_by_higher_slot(std::span<InstancePair> pairs) {
    for (std::size_t first = 0; first < pairs.size();) {
        std::size_t end = first + 1;
        while (end < pairs.size() && pairs[end].a == pairs[first].a) ++end;
        sort(pairs.subspan(first, end - first));
        first = end;
    }
}

}  // namespace

bool TouchingPairs::is_selected(const InstancePair& pair) const {
    const auto [a, b] = pair;
    if ((block_.masks[a] & block_.masks[b]) == 0) return false;
    if (filter_.only_moved && !has_moved(block_, a) && !has_moved(block_, b)) return false;
    return !filter_.keep || filter_.keep(InstanceId{a}, InstanceId{b});
}

/// Returns whether a walk from each that has moved takes less than one for all.
bool TouchingPairs::are_few_moved() const {
    std::uint32_t count = 0;
    for (std::uint32_t slot = 0; slot < block_.head->slots_used; ++slot) count += has_moved(block_, slot) ? 1u : 0u;
    return count < block_.head->live / 4;
}

bool TouchingPairs::collect_all(std::span<InstancePair> out, std::size_t& count) {
    const std::uint32_t slots = block_.head->slots_used;
    std::uint32_t* const counts = block_.counts;
    for (std::uint32_t a = 0; a < slots; ++a) counts[a] = 0;
    const std::uint64_t room = out.size() < UINT32_MAX ? out.size() : UINT32_MAX;
    std::uint64_t found = 0;
    const bool starts_at_moved = filter_.only_moved && are_few_moved();
    const JoinedSlots joined = starts_at_moved ? JoinedSlots::moved : JoinedSlots::all;
    join_(block_, joined, 0, [&](std::span<const InstancePair> touching) {
        for (const auto [x, y] : touching) {
            // Two that have moved are met twice.
            if (starts_at_moved && y < x && has_moved(block_, y)) continue;
            const InstancePair pair = x < y ? InstancePair{x, y} : InstancePair{y, x};
            if (!is_selected(pair)) continue;
            ++counts[pair.a];
            if (found < room) out[static_cast<std::size_t>(found)] = pair;
            ++found;
        }
    });
    if (found <= room) {
        count = static_cast<std::size_t>(found);
        sort_by_lower_slot(out.first(count), counts, slots);
        sort_by_higher_slot(out.first(count));
    }
    clear_others(slots);
    return found <= room;
}

std::span<const std::uint32_t> TouchingPairs::find_others(InstancePair from) {
    if (!is_live(block_.slots[from.a])) return {};
    std::size_t count = 0;
    join_(block_, JoinedSlots::one, from.a, [&](std::span<const InstancePair> touching) {
        for (const auto [a, b] : touching)
            if (b > a && b >= from.b) block_.counts[count++] = b;
    });
    const std::span others(block_.counts, count);
    sort(others);
    return others;
}

void TouchingPairs::clear_others(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) block_.counts[i] = 0;
}

FilledPairs<InstancePair> collect_touching_pairs(SceneBlock& block, std::span<InstancePair> out,
                                                 const PairFilter& filter, InstancePair from, SelfJoin join) {
    TouchingPairs pairs(block, filter, join);
    PairPage<InstancePair> page = {out, {0, pairs.end(), QueryStatus::ok}};
    if (takes_shortcut(from == InstancePair{}) && pairs.collect_all(out, page.filled.count)) return page.filled;
    pairs.for_each_from(from, [&](const InstancePair& pair) { return page.take(pair, QueryStatus::ok); });
    return page.filled;
}

}  // namespace espalier::detail
