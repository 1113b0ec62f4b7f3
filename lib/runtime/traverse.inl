// The two ways through a tree. Included once per instruction set, inside its namespace.
// A visitor offers:
//   unsigned children(const FastNode&, float* keys)  mask of the children worth a visit, and for each how near it is
//   float limit() const                              children with a larger key are passed over
//   Visit leaf(const FastLeaf&)                      stop ends the walk

/// Children with the smallest keys first: for queries whose limit shrinks as they find something.
template <class Visitor>
inline void traverse_nearest_first(const BlobData& blob, Visitor& visitor) {
    struct Entry {
        std::uint32_t node;
        float key;
    };
    // Every level but the last leaves at most all children but one behind.
    Entry stack[(format::max_depth - 1) * (format::max_children - 1) + 1];
    unsigned size = 0;
    std::uint32_t index = 0;
    for (;;) {
        const FastNode node = fast_node(blob, index);
        alignas(32) float keys[format::max_children];
        const unsigned mask = visitor.children(node, keys);
        const unsigned node_children = node.node_children();
        for (unsigned leaves = mask >> node_children; leaves != 0; leaves &= leaves - 1) {
            const auto number = static_cast<unsigned>(std::countr_zero(leaves));
            if (keys[node_children + number] <= visitor.limit())
                if (visitor.leaf(fast_leaf(blob, node, number)) == stop) return;
        }
        unsigned nodes = mask & ((1u << node_children) - 1u);
        if (nodes != 0) {
            // The nearest child is next; the others wait, the nearer ones on top.
            const std::uint32_t first = node.first_child();
            const unsigned bottom = size;
            for (; nodes != 0; nodes &= nodes - 1) {
                const auto child = static_cast<unsigned>(std::countr_zero(nodes));
                const Entry entry = {first + child, keys[child]};
                prefetch(fast_node(blob, entry.node).bytes);
                unsigned place = size++;
                for (; place > bottom && stack[place - 1].key < entry.key; --place) stack[place] = stack[place - 1];
                stack[place] = entry;
            }
        }
        do {
            if (size == 0) return;
            --size;
        } while (!(stack[size].key <= visitor.limit()));
        index = stack[size].node;
    }
}

/// Children in storage order: for queries that enumerate, or that are done at the first find. True when it saw them all.
template <class Visitor>
inline bool traverse_in_storage_order(const BlobData& blob, Visitor& visitor) {
    struct Level {
        std::uint32_t first_child;
        std::uint32_t waiting;
    };
    Level stack[format::max_depth];
    unsigned depth = 0;
    std::uint32_t index = 0;
    for (;;) {
        const FastNode node = fast_node(blob, index);
        alignas(32) float keys[format::max_children];
        const unsigned mask = visitor.children(node, keys);
        const unsigned node_children = node.node_children();
        for (unsigned leaves = mask >> node_children; leaves != 0; leaves &= leaves - 1)
            if (visitor.leaf(fast_leaf(blob, node, static_cast<unsigned>(std::countr_zero(leaves)))) == stop) return false;
        if (const unsigned nodes = mask & ((1u << node_children) - 1u); nodes != 0)
            stack[depth++] = {node.first_child(), nodes};
        if (depth == 0) return true;
        Level& level = stack[depth - 1];
        index = level.first_child + static_cast<unsigned>(std::countr_zero(level.waiting));
        level.waiting &= level.waiting - 1;
        if (level.waiting == 0) --depth;
    }
}
