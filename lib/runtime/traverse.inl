// The two ways through a tree. Included once per instruction set, inside its namespace.
// A visitor offers:
//   unsigned children(const Node&, float* keys)  mask of the children worth a visit, and for each how near it is
//   float limit() const                              children with a larger key are passed over
//   Visit visit_leaf(const Leaf&)                    stop ends the walk

/// Calls the function for the kind of leaf that the blob has.
template <class Function>
inline auto with_leaves_of(const BlobData& blob, Function function) {
    if constexpr (!reads_strip_leaves) return function.template operator()<IndexedLeaf>();
    else if constexpr (!reads_indexed_leaves) return function.template operator()<StripLeaf>();
    else if (has_indexed_leaves(blob.profile)) return function.template operator()<IndexedLeaf>();
    else return function.template operator()<StripLeaf>();
}

/// A walk to the children with the smallest keys first: for queries whose limit shrinks as they find something. Keys
/// are not negative, so that their bits order like integers: a waiting node is one word, its key above its index. A
/// step is in two halves, so that batches can test the nodes of several rays before they branch on any.
template <class Leaf, class Visitor>
struct NearestFirst {
    // Every level but the last leaves at most all children but one behind.
    std::uint64_t stack[(format::max_depth - 1) * (format::max_children - 1) + 1];
    unsigned size = 0;
    std::uint32_t index = 0;  ///< of the node that is next
    alignas(32) float keys[format::max_children];

    /// First half: which children are worth a visit.
    [[gnu::always_inline]] unsigned test(const BlobData& blob, Visitor& visitor) {
        return visitor.children(node_at(blob, index), keys);
    }

    /// Second half: visits the leaves among them and chooses the next node. False when the walk is over.
    [[gnu::always_inline]] bool advance(const BlobData& blob, Visitor& visitor, unsigned mask) {
        const Node node = node_at(blob, index);
        const unsigned node_children = node.node_children();
        // A leaf is tried before the nodes beside it: what it finds may spare them.
        for (unsigned leaves = mask >> node_children; leaves != 0; leaves &= leaves - 1) {
            const auto number = static_cast<unsigned>(std::countr_zero(leaves));
            if (keys[node_children + number] <= visitor.limit())
                if (visitor.visit_leaf(leaf_at<Leaf>(blob, node, number)) == stop) return false;
        }
        unsigned nodes = mask & ((1u << node_children) - 1u);
        if (nodes != 0) {
            const std::uint32_t first_child = node.first_child();
            const auto child = static_cast<unsigned>(std::countr_zero(nodes));
            nodes &= nodes - 1;
            if (nodes == 0) {  // most often: nothing to sort, and the next address does not wait for its key
                if (keys[child] <= visitor.limit()) {
                    index = first_child + child;
                    return true;
                }
            } else {
                const auto entry_of = [&](unsigned number) {
                    prefetch(node_at(blob, first_child + number).bytes);
                    return std::uint64_t{std::bit_cast<std::uint32_t>(keys[number])} << 32 | (first_child + number);
                };
                // The nearest is next; the others wait, the nearer ones on top.
                std::uint64_t nearest = entry_of(child);
                const unsigned bottom = size;
                for (; nodes != 0; nodes &= nodes - 1) {
                    const std::uint64_t other = entry_of(static_cast<unsigned>(std::countr_zero(nodes)));
                    const std::uint64_t waits = other < nearest ? nearest : other;
                    nearest = other < nearest ? other : nearest;
                    unsigned place = size++;
                    for (; place > bottom && stack[place - 1] < waits; --place) stack[place] = stack[place - 1];
                    stack[place] = waits;
                }
                if (static_cast<std::uint32_t>(nearest >> 32) <= std::bit_cast<std::uint32_t>(visitor.limit())) {
                    index = static_cast<std::uint32_t>(nearest);
                    return true;
                }
            }
        }
        std::uint64_t next = 0;
        do {
            if (size == 0) return false;
            next = stack[--size];
        } while (static_cast<std::uint32_t>(next >> 32) > std::bit_cast<std::uint32_t>(visitor.limit()));
        index = static_cast<std::uint32_t>(next);
        return true;
    }
};

/// All of a walk, from the root or from the node of that index on.
template <class Leaf, class Visitor>
inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor, std::uint32_t index = 0) {
    NearestFirst<Leaf, Visitor> walk;
    walk.index = index;
    while (walk.advance(blob, visitor, walk.test(blob, visitor))) {
    }
}

/// Children in storage order: for queries that enumerate, or that are done at the first find. `stop` when the visitor
/// said so.
template <class Leaf, class Visitor>
inline Visit traverse_in_storage_order(const BlobData& blob, Visitor& visitor) {
    struct Level {
        std::uint32_t first_child;
        std::uint32_t waiting;
    };
    Level stack[format::max_depth];
    unsigned depth = 0;
    std::uint32_t index = 0;
    for (;;) {
        const Node node = node_at(blob, index);
        alignas(32) float keys[format::max_children];
        const unsigned mask = visitor.children(node, keys);
        const unsigned node_children = node.node_children();
        for (unsigned leaves = mask >> node_children; leaves != 0; leaves &= leaves - 1)
            if (visitor.visit_leaf(leaf_at<Leaf>(blob, node, static_cast<unsigned>(std::countr_zero(leaves)))) == stop)
                return stop;
        if (const unsigned nodes = mask & ((1u << node_children) - 1u); nodes != 0)
            stack[depth++] = {node.first_child(), nodes};
        if (depth == 0) return keep_going;
        Level& level = stack[depth - 1];
        index = level.first_child + static_cast<unsigned>(std::countr_zero(level.waiting));
        level.waiting &= level.waiting - 1;
        if (level.waiting == 0) --depth;
    }
}
