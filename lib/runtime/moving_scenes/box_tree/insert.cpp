// Insertion into the tree: the leaf node with which boxes grow least, and a split of full nodes along the axis with the
// least area.
#include <runtime/moving_scenes/box_tree/tree.hpp>

namespace espalier::detail {

namespace {

/// Nodes whose children the search for a leaf node compares at most, if the first leaf node came sooner.
constexpr unsigned most_compared = 24;

/// The children of a node, those whose boxes grow least by another box first; of equal ones the smaller.
struct OrderedChildren {
    float growth[BoxNode::most];
    std::uint8_t order[BoxNode::most];
    unsigned count = 0;

    OrderedChildren(const BoxNode& node, const StepsBox& box) {
        float area[BoxNode::most];
        for (unsigned i = 0; i < BoxNode::most; ++i) {
            StepsBox both = node.box(i);
            area[i] = both.half_area();
            both.add(box);
            growth[i] = both.half_area() - area[i];
        }
        for (unsigned i = 0; i < BoxNode::most; ++i) {
            if (node.child[i] == no_child) continue;
            const auto is_before = [&](unsigned other) {
                return growth[i] < growth[other] || (growth[i] == growth[other] && area[i] < area[other]);
            };
            unsigned at = count++;
            for (; at > 0 && is_before(order[at - 1]); --at) order[at] = order[at - 1];
            order[at] = static_cast<std::uint8_t>(i);
        }
    }
};

/// A node in which a box may go, and by how much the boxes down to it would grow together.
struct Candidate {
    float growth;
    std::uint32_t number;  ///< 16 * node + level
};

/// Returns the leaf node with the least growth of the boxes on the way, by branch and bound: first the way of least
/// growth at each node, then the others, until as many nodes were compared as are allowed (Bittner et al. 2015).
std::uint32_t find_leaf_node(const SceneBlock& block, const StepsBox& box) {
    const BlockHead& head = *block.head;
    Candidate waiting[most_tree_levels * (BoxNode::most - 1) + 1];
    unsigned size = 1, compared = 0;
    waiting[0] = {0.0f, 16 * head.root + (head.levels - 1u)};
    Candidate best = {infinity, 0};
    while (size != 0 && (compared < most_compared || best.growth == infinity)) {
        const Candidate nearest = waiting[--size];
        if (nearest.growth >= best.growth) continue;
        const std::uint32_t level = nearest.number % 16;
        if (level == 0) {
            best = nearest;
            continue;
        }
        ++compared;
        const BoxNode& node = block.node(nearest.number / 16);
        const OrderedChildren children(node, box);
        for (unsigned i = children.count; i-- > 0;) {
            const float growth = nearest.growth + children.growth[children.order[i]];
            if (growth < best.growth) waiting[size++] = {growth, 16 * node.child[children.order[i]] + (level - 1)};
        }
    }
    return best.number / 16;
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
    float least = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        std::uint8_t order[entries_of_split];
        sort_along(entries, axis, order);
        float behind[entries_of_split];  // of the parts from each place on
        StepsBox box = StepsBox::none();
        for (unsigned i = entries_of_split; i-- > 0;) {
            box.add(entries[order[i]].box);
            behind[i] = box.half_area();
        }
        box = StepsBox::none();
        for (unsigned size = 1; size <= entries_of_split - BoxNode::least; ++size) {
            box.add(entries[order[size - 1]].box);
            if (size < BoxNode::least) continue;
            const float sum = box.half_area() + behind[size];
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

/// Returns how many nodes another child of a leaf node takes: one for each full node on its way to the root, and a
/// root.
std::uint32_t count_nodes_to_take(const SceneBlock& block, std::uint32_t leaf_node) {
    std::uint32_t count = 0;
    for (std::uint32_t node = leaf_node; block.node(node).free_place() == BoxNode::most;
         node = block.parent[node] / 8) {
        ++count;
        if (block.parent[node] == no_child) return count + 1;
    }
    return count;
}

}  // namespace

void insert_box(SceneBlock& block, std::uint32_t slot) {
    BlockHead& head = *block.head;
    Entry entry = {block.slots[slot].box, slot};
    if (head.levels == 0) {
        head.root = take_node(block);
        head.levels = 1;
    }
    std::uint32_t node = find_leaf_node(block, entry.box);
    if (head.node_capacity - head.nodes_used + head.free_nodes < count_nodes_to_take(block, node))
        return repack_boxes(block);
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
