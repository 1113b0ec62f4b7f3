// Insertion into the tree: the child that grows least, and a split of full nodes along the axis with the least area.
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::detail {

namespace {

StepsBox joined(const StepsBox& a, const StepsBox& b) {
    StepsBox all = a;
    all.add(b);
    return all;
}

/// Returns the place of the child whose box grows least; of equal ones the smallest, then the first.
unsigned least_growth(const BoxNode& node, const StepsBox& box) {
    unsigned best = 0;
    std::int64_t least_growth = INT64_MAX, least_area = INT64_MAX;
    for (unsigned i = 0; i < BoxNode::most; ++i) {
        if (node.child[i] == no_child) continue;
        const StepsBox own = node.box(i);
        const std::int64_t area = own.half_area(), growth = joined(own, box).half_area() - area;
        if (growth > least_growth || (growth == least_growth && area >= least_area)) continue;
        best = i;
        least_growth = growth;
        least_area = area;
    }
    return best;
}

/// A child that is to be put into a node.
struct Entry {
    StepsBox box;
    std::uint32_t child;
};

inline constexpr unsigned entries_of_split = BoxNode::most + 1;

/// Sorts by the middles along an axis; equal ones keep their order.
void sort_along(const Entry* entries, int axis, std::uint8_t (&order)[entries_of_split]) {
    const auto middle = [&](std::uint8_t i) {
        return std::int64_t{entries[i].box.low[axis]} + entries[i].box.high[axis];
    };
    for (unsigned i = 0; i < entries_of_split; ++i) {
        unsigned at = i;
        const auto number = static_cast<std::uint8_t>(i);
        for (; at > 0 && middle(order[at - 1]) > middle(number); --at) order[at] = order[at - 1];
        order[at] = number;
    }
}

/// A way to part nine entries in two.
struct Cut {
    std::uint8_t order[entries_of_split];
    unsigned size = 0;  ///< of the first part
};

/// Returns the cut along an axis with the least sum of areas of the two parts; each part has enough for a node.
Cut best_cut(const Entry* entries) {
    Cut best;
    std::int64_t least = INT64_MAX;
    for (int axis = 0; axis < 3; ++axis) {
        std::uint8_t order[entries_of_split];
        sort_along(entries, axis, order);
        std::int64_t behind[entries_of_split];  // of the parts from each place on
        StepsBox box = StepsBox::none();
        for (unsigned i = entries_of_split; i-- > 0;) {
            box.add(entries[order[i]].box);
            behind[i] = box.half_area();
        }
        box = StepsBox::none();
        for (unsigned size = 1; size <= entries_of_split - BoxNode::least; ++size) {
            box.add(entries[order[size - 1]].box);
            if (size < BoxNode::least) continue;
            const std::int64_t sum = box.half_area() + behind[size];
            if (sum >= least) continue;
            least = sum;
            best.size = size;
            for (unsigned i = 0; i < entries_of_split; ++i) best.order[i] = order[i];
        }
    }
    return best;
}

/// Parts the children of a full node and one more in two nodes. Returns the new one.
std::uint32_t split(SceneBlock& block, std::uint32_t level, std::uint32_t node, const Entry& more) {
    Entry entries[entries_of_split];
    for (unsigned i = 0; i < BoxNode::most; ++i) entries[i] = {block.node(node).box(i), block.node(node).child[i]};
    entries[BoxNode::most] = more;
    const Cut cut = best_cut(entries);
    const std::uint32_t other = take_node(block);
    block.node(node).clear();
    for (unsigned i = 0; i < entries_of_split; ++i) {
        const Entry& entry = entries[cut.order[i]];
        const bool is_first = i < cut.size;
        put_child(block, level, is_first ? node : other, is_first ? i : i - cut.size, entry.box, entry.child);
    }
    return other;
}

}  // namespace

void insert_box(SceneBlock& block, std::uint32_t slot) {
    BlockHead& head = *block.head;
    // A split for each level, and a root.
    if (head.node_capacity - head.nodes_used + head.free_nodes < head.levels + 1u) return repack_boxes(block);
    Entry entry = {block.slots[slot].box, slot};
    if (head.levels == 0) {
        head.root = take_node(block);
        head.levels = 1;
    }
    std::uint32_t node = head.root;
    for (std::uint32_t level = head.levels - 1; level > 0; --level)
        node = block.node(node).child[least_growth(block.node(node), entry.box)];
    for (std::uint32_t level = 0;; ++level) {
        const unsigned place = block.node(node).free_place();
        if (place < BoxNode::most) {
            put_child(block, level, node, place, entry.box, entry.child);
            renew_ancestors(block, node);
            return;
        }
        const std::uint32_t other = split(block, level, node, entry);
        entry = {block.node(other).bounds(), other};
        if (block.parent[node] == no_child) {
            const std::uint32_t root = take_node(block);
            put_child(block, level + 1, root, 0, block.node(node).bounds(), node);
            put_child(block, level + 1, root, 1, entry.box, entry.child);
            head.root = root;
            ++head.levels;
            return;
        }
        const std::uint32_t above = block.parent[node];
        block.node(above / 8).set_box(above % 8, block.node(node).bounds());
        node = above / 8;
    }
}

}  // namespace espalier::detail
