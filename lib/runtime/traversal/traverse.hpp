// The two ways through a tree.
// A visitor offers:
//   unsigned children(const Node&, Keys keys)    mask of the children worth a visit, and for each how near it is
//   float limit() const                              children with a larger key are passed over
//   Visit visit_leaf(const Leaf&)                    stop ends the walk
// Keys are not negative and only compared, by their bits: a query without floats may hand over integers as such.
#ifndef ESPALIER_TRAVERSAL_TRAVERSE_HPP
#define ESPALIER_TRAVERSAL_TRAVERSE_HPP

#include <bit>
#include <cstdint>
#include <type_traits>

#include <runtime/answers/answer.hpp>
#include <runtime/lanes/set.hpp>

ESPALIER_BEGIN_SET

using Keys = float*;  ///< one for each child
using Limit = float;

/// What waits at a node on the way down: the second nearest of its children worth a visit, how near that is, and which
/// others there are, none of them nearer. Keys are not negative, so that their bits order like integers; the lowest
/// bits make room for the child's number, which keeps the order of any two keys or makes them equal. Once the second
/// has had its turn, a child of the others stands in its place.
template <class Node>
struct WaitingChildren {
    static constexpr unsigned node_bits = 24;
    static constexpr std::uint32_t child_mask = Node::max_children - 1;
    static_assert(format::max_nodes <= 1u << node_bits && std::has_single_bit(Node::max_children));
    static constexpr std::uint32_t entry(float key, unsigned child) {
        return (std::bit_cast<std::uint32_t>(key) & ~child_mask) | child;
    }

    std::uint64_t second_and_node;
    /// The others: with few children they have room above the node.
    struct Nothing {};
    [[no_unique_address]] std::conditional_t<Node::max_children <= 8, Nothing, std::uint32_t> more;

    WaitingChildren() = default;
    ESPALIER_ALWAYS_INLINE WaitingChildren(std::uint32_t second, unsigned others, std::uint32_t node)
        : second_and_node(std::uint64_t{second} << 32 | node) {
        set_others(others);
    }
    [[nodiscard]] bool is_within(float limit) const {
        return static_cast<std::uint32_t>(second_and_node >> 32) <= (std::bit_cast<std::uint32_t>(limit) | child_mask);
    }
    [[nodiscard]] unsigned child() const { return static_cast<unsigned>(second_and_node >> 32) & child_mask; }
    [[nodiscard]] unsigned others() const {
        if constexpr (Node::max_children <= 8) return static_cast<unsigned>(second_and_node >> node_bits) & 255u;
        else return more;
    }
    [[nodiscard]] std::uint32_t node() const {
        return static_cast<std::uint32_t>(second_and_node) & ((1u << node_bits) - 1u);
    }
    /// A child of the others in its place.
    void drop_second() {
        const auto from_others = static_cast<std::uint32_t>(std::countr_zero(others()));
        second_and_node = (second_and_node & ~(std::uint64_t{child_mask} << 32)) | std::uint64_t{from_others} << 32;
    }

private:
    void set_others(unsigned others) {
        if constexpr (Node::max_children <= 8) second_and_node |= others << node_bits;
        else more = others;
    }
};

/// True for types that declare their leaves to cost more than several nodes.
template <class Type>
concept DeclaresCostlyLeaves = requires {
    typename Type::CostlyLeaves;
};
/// True for visitors that do so, or that have a shape which does: leaves with no nodes beside them are then ordered,
/// too.
template <class Visitor>
inline constexpr bool has_costly_leaves = DeclaresCostlyLeaves<Visitor> || requires(Visitor visitor) {
    requires DeclaresCostlyLeaves<std::remove_cvref_t<decltype(visitor.shape)>>;
};

/// A walk to the children with the smallest keys first: for queries whose limit shrinks as they find something. A leaf
/// waits for nodes beside it that are nearer; leaves with no nodes beside them are taken as they lie, unless they are
/// costly. Of a node's children two are put in order; when both have had their turn and there are more that may matter,
/// the node is tested again: that is rare, more exact by then, and keeps the stack to a word a level. A step is in two
/// halves, so that batches can test the nodes of several rays before they branch on any.
template <class Leaf, class Visitor>
struct NearestFirst {
    using Node = typename Leaf::Node;
    using Waiting = WaitingChildren<Node>;
    static constexpr unsigned every_child = every_child_of<Node>;

    Waiting stack[format::max_depth];
    unsigned size = 0;
    std::uint32_t index = 0;       ///< of the node that is next
    unsigned among = every_child;  ///< the children of it that are still to be visited
    alignas(register_alignment) float keys[Node::max_children];

    void begin(std::uint32_t node) {
        size = 0;
        index = node;
        among = every_child;
    }

    /// First half: which children are worth a visit.
    ESPALIER_ALWAYS_INLINE unsigned test(const BlobData& blob, Visitor& visitor) {
        count_node_step();
        return visitor.children(node_at<Node>(blob, index), keys) & among;
    }

    /// Second half: visits leaves until it is a node's turn. False when the walk is over.
    ESPALIER_ALWAYS_INLINE bool advance(const BlobData& blob, Visitor& visitor, unsigned mask) {
        unsigned leaves = 0;
        return descend(blob, mask, leaves) || visit_leaves(blob, visitor, leaves);
    }
    /// True when a node below is next, else the leaves of this one are. Apart from those: from node to node a walk then
    /// keeps its numbers in registers.
    ESPALIER_ALWAYS_INLINE bool descend(const BlobData& blob, unsigned mask, unsigned& leaves) {
        const NodeChildren children(node_at<Node>(blob, index));
        const unsigned node_children = children.nodes();
        leaves = mask >> node_children;
        among = every_child;
        if ((mask & ((1u << node_children) - 1u)) == 0) return false;
        // Most often there is one: nothing to sort, and the next address does not wait for its key.
        // mutant(- -> right side dropped) work: sorts a single child too and leaves nothing waiting
        const unsigned child =
            (mask & (mask - 1)) == 0 ? static_cast<unsigned>(std::countr_zero(mask)) : nearest_of(mask);
        if (child < node_children) {
            index = children.first() + child;
            return true;
        }
        leaves = 1u << (child - node_children);
        return false;
    }
    /// Visits leaves until it is a node's turn. False when the walk is over.
    ESPALIER_ALWAYS_INLINE bool visit_leaves(const BlobData& blob, Visitor& visitor, unsigned leaves) {
        std::uint32_t parent = index;  // of the leaves
        for (;;) {
            while (leaves != 0) {
                const Node node = node_at<Node>(blob, parent);
                auto number = static_cast<unsigned>(std::countr_zero(leaves));
                if constexpr (has_costly_leaves<Visitor>)
                    if (parent == index) number = nearest_leaf(leaves, node.node_children());
                leaves &= ~(1u << number);
                if (parent == index && is_beyond(keys[node.node_children() + number], visitor.limit())) continue;
                count_leaf_step();
                if ((visit_leaf<Leaf>)(blob, node, number, visitor) == Visit::stop) return false;
            }
            Waiting next;
            do {
                if (size == 0) return false;
                next = stack[--size];
            } while (!next.is_within(visitor.limit()));
            parent = next.node();
            const unsigned others = next.others();
            const unsigned child = next.child();
            if ((others >> child & 1u) != 0) {  // the others' turn
                index = parent;
                among = others;
                return true;
            }
            if (others != 0) {
                next.drop_second();
                stack[size++] = next;
            }
            const NodeChildren children(node_at<Node>(blob, parent));
            if (child < children.nodes()) {
                index = children.first() + child;
                return true;
            }
            leaves = 1u << (child - children.nodes());
        }
    }

private:
    static bool is_beyond(float key, float limit) {
        return std::bit_cast<std::uint32_t>(key) > std::bit_cast<std::uint32_t>(limit);
    }
    /// Returns the number of the nearest of some leaves of the node at hand.
    [[nodiscard]] unsigned nearest_leaf(unsigned leaves, unsigned node_children) const {
        std::uint32_t nearest = ~0u;
        for (; leaves != 0; leaves &= leaves - 1) {
            const auto number = static_cast<unsigned>(std::countr_zero(leaves));
            const std::uint32_t entry = Waiting::entry(keys[node_children + number], number);
            // mutant(< -> <=) equivalent: no two entries are equal, since each contains its number
            nearest = entry < nearest ? entry : nearest;
        }
        return nearest & Waiting::child_mask;
    }
    /// The nearest of several children of the node at hand; the others are left waiting. Compared and chosen as plain
    /// words: no processor could foresee branches here.
    ESPALIER_ALWAYS_INLINE unsigned nearest_of(unsigned mask) {
        auto child = static_cast<unsigned>(std::countr_zero(mask));
        std::uint32_t nearest = Waiting::entry(keys[child], child);
        std::uint32_t second = ~0u;
        for (unsigned others = mask & (mask - 1); others != 0; others &= others - 1) {
            child = static_cast<unsigned>(std::countr_zero(others));
            const std::uint32_t entry = Waiting::entry(keys[child], child);
            // mutant(< -> <=) equivalent: no two entries are equal, since each contains its child's number
            const std::uint32_t farther = entry < nearest ? nearest : entry;
            // mutant(< -> <=) equivalent: no two entries are equal, since each contains its child's number
            nearest = entry < nearest ? entry : nearest;
            // mutant(< -> <=) equivalent: no two entries are equal, since each contains its child's number
            second = farther < second ? farther : second;
        }
        const unsigned others =
            mask & ~(1u << (nearest & Waiting::child_mask)) & ~(1u << (second & Waiting::child_mask));
        stack[size++] = Waiting(second, others, index);
        return nearest & Waiting::child_mask;
    }
};

/// All of a walk, from the root or from the node of that index on.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor,
                                                          std::uint32_t index = 0) {
    NearestFirst<Leaf, Visitor> walk;
    walk.index = index;
    for (;;) {
        unsigned leaves = 0;
        while (walk.descend(blob, walk.test(blob, visitor), leaves)) {
        }
        if (!walk.visit_leaves(blob, visitor, leaves)) return;
    }
}

enum class Step : std::uint8_t { goes_on, is_over, was_stopped };

/// A walk to the children in storage order: for queries that enumerate, or that are done at the first find. A step is
/// in two halves here too.
template <class Leaf, class Visitor>
struct StorageOrder {
    using Node = typename Leaf::Node;

    struct Level {
        std::uint32_t first_child;
        std::uint32_t waiting;
    };

    Level stack[format::max_depth];
    unsigned depth = 0;
    std::uint32_t index = 0;  ///< of the node that is next

    void begin() {
        depth = 0;
        index = 0;
    }

    /// First half: which children are worth a visit.
    ESPALIER_ALWAYS_INLINE unsigned test(const BlobData& blob, Visitor& visitor) {
        alignas(register_alignment) float keys[Node::max_children];
        count_node_step();
        return visitor.children(node_at<Node>(blob, index), keys);
    }
    /// Second half: visits the leaves among them and goes on to a node. Stopped when the visitor returned that.
    ESPALIER_ALWAYS_INLINE Step advance(const BlobData& blob, Visitor& visitor, unsigned mask) {
        const Node node = node_at<Node>(blob, index);
        const NodeChildren children(node);
        const unsigned node_children = children.nodes();
        for (unsigned leaves = mask >> node_children; leaves != 0; leaves &= leaves - 1) {
            count_leaf_step();
            if ((visit_leaf<Leaf>)(blob, node, static_cast<unsigned>(std::countr_zero(leaves)), visitor) == Visit::stop)
                return Step::was_stopped;
        }
        if (const unsigned nodes = mask & ((1u << node_children) - 1u); nodes != 0)
            stack[depth++] = {children.first(), nodes};
        if (depth == 0) return Step::is_over;
        Level& level = stack[depth - 1];
        index = level.first_child + static_cast<unsigned>(std::countr_zero(level.waiting));
        level.waiting &= level.waiting - 1;
        if (level.waiting == 0) --depth;
        return Step::goes_on;
    }
};

/// All of a walk. `stop` when the visitor returned that. In the caller's frame.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline Visit walk_in_storage_order(const BlobData& blob, Visitor& visitor) {
    StorageOrder<Leaf, Visitor> walk;
    for (;;) {
        const Step step = walk.advance(blob, visitor, walk.test(blob, visitor));
        if (step != Step::goes_on) return step == Step::was_stopped ? Visit::stop : Visit::next;
    }
}

/// The walk in storage order, in a frame of its own.
template <class Leaf, class Visitor>
ESPALIER_NOINLINE Visit traverse_in_storage_order(const BlobData& blob, Visitor& visitor) {
    return (walk_in_storage_order<Leaf>)(blob, visitor);
}

ESPALIER_END_SET

#endif
