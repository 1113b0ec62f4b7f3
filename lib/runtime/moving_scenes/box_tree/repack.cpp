// The tree built anew: instances in Hilbert order, as many in a node as it may hold (Kamel and Faloutsos 1994).
#include <runtime/moving_scenes/box_tree/hilbert.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::detail {

namespace {

constexpr unsigned key_bits = 10;  ///< of each coordinate
constexpr unsigned digit_bits = 8;
constexpr std::uint32_t digits = 1u << digit_bits;

/// An instance on the curve.
struct Keyed {
    std::uint32_t key;
    std::uint32_t slot;
};

/// Sorts by one digit of the key; equal digits keep their order.
void sort_by_digit(const Keyed* from, Keyed* to, std::uint32_t count, unsigned shift) {
    std::uint32_t starts[digits] = {};
    for (std::uint32_t i = 0; i < count; ++i) ++starts[from[i].key >> shift & (digits - 1)];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : starts) {
        const std::uint32_t size = start;
        start = sum;
        sum += size;
    }
    for (std::uint32_t i = 0; i < count; ++i) to[starts[from[i].key >> shift & (digits - 1)]++] = from[i];
}

/// Writes the live slots with their keys.
void find_keys(const SceneBlock& block, Keyed* keyed) {
    StepsBox all = StepsBox::none();
    for (std::uint32_t i = 0; i < block.head->slots_used; ++i)
        if (is_live(block.slots[i])) all.add(block.slots[i].box);
    std::int64_t extent = 1;
    for (int k = 0; k < 3; ++k) {
        const std::int64_t side = std::int64_t{all.high[k]} - all.low[k];
        extent = side > extent ? side : extent;
    }
    // Middles are counted in half steps.
    unsigned shift = 0;
    while ((2 * extent) >> shift >= 1 << key_bits) ++shift;
    for (std::uint32_t i = 0, count = 0; i < block.head->slots_used; ++i) {
        if (!is_live(block.slots[i])) continue;
        const StepsBox& box = block.slots[i].box;
        std::uint32_t at[3];
        for (int k = 0; k < 3; ++k)
            at[k] = static_cast<std::uint32_t>(
                (std::int64_t{box.low[k]} + box.high[k] - 2 * std::int64_t{all.low[k]}) >> shift);
        keyed[count++] = {hilbert_key(at[0], at[1], at[2], key_bits), i};
    }
}

}  // namespace

void repack_boxes(SceneBlock& block) {
    BlockHead& head = *block.head;
    head.nodes_used = 0;
    head.free_node = no_child;
    head.free_nodes = 0;
    head.root = no_child;
    head.levels = 0;
    const std::uint32_t live = head.live;
    if (live == 0) return;
    // The last nodes have room for the keys (least_nodes_of): 16 bytes an instance to sort them, and 8 beside the nodes
    // that are written then.
    void* const end = block.nodes + head.node_capacity;
    Keyed* const first = static_cast<Keyed*>(end) - live;
    Keyed* const second = first - live;
    find_keys(block, first);
    static_assert(3 * key_bits <= 4 * digit_bits);
    sort_by_digit(first, second, live, 0);
    sort_by_digit(second, first, live, digit_bits);
    sort_by_digit(first, second, live, 2 * digit_bits);
    sort_by_digit(second, first, live, 3 * digit_bits);

    // All nodes of a level have nearly as many children: at least half as many as they may have.
    std::uint32_t count = live, first_below = 0;
    for (std::uint32_t level = 0;; ++level) {
        const std::uint32_t nodes = (count + BoxNode::most - 1) / BoxNode::most;
        const std::uint32_t first_node = head.nodes_used;
        const std::uint32_t each = count / nodes, with_one_more = count % nodes;
        for (std::uint32_t i = 0, from = 0, to = 0; i < nodes; ++i, from = to) {
            to = from + each + (i < with_one_more ? 1u : 0u);
            const std::uint32_t node = take_node(block);
            for (std::uint32_t k = from; k < to; ++k) {
                const std::uint32_t child = level == 0 ? first[k].slot : first_below + k;
                const StepsBox box = level == 0 ? block.slots[child].box : block.node(child).bounds();
                put_child(block, level, node, k - from, box, child);
            }
        }
        ++head.levels;
        if (nodes == 1) {
            head.root = first_node;
            return;
        }
        first_below = first_node;
        count = nodes;
    }
}

}  // namespace espalier::detail
