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

/// What waits for its turn: a node, or one leaf of a node, and above it how near it is. Keys are not negative, so that
/// their bits order like integers.
struct Waiting {
    static constexpr unsigned leaf_shift = 24;
    static constexpr std::uint32_t leaf_bit = 1u << 31;
    static_assert(format::max_nodes <= 1u << leaf_shift && format::max_children <= 8);

    std::uint64_t packed;

    [[nodiscard]] bool is_within(float limit) const {
        return static_cast<std::uint32_t>(packed >> 32) <= std::bit_cast<std::uint32_t>(limit);
    }
    [[nodiscard]] bool is_leaf() const { return (packed & leaf_bit) != 0; }
    [[nodiscard]] unsigned leaf() const { return static_cast<unsigned>(packed >> leaf_shift) & 7u; }
    /// The node, or the one whose leaf it is.
    [[nodiscard]] std::uint32_t node() const { return static_cast<std::uint32_t>(packed) & ((1u << leaf_shift) - 1u); }
};

/// A walk to the children with the smallest keys first: for queries whose limit shrinks as they find something. A leaf
/// waits for nodes beside it that are nearer; leaves with no nodes beside them are taken as they lie. A step is in two
/// halves, so that batches can test the nodes of several rays before they branch on any.
template <class Leaf, class Visitor>
struct NearestFirst {
    // Every level but the last, which has no nodes among its children, leaves at most all but one of them behind.
    std::uint64_t stack[(format::max_depth - 1) * (format::max_children - 1)];  // packed
    unsigned size = 0;
    std::uint32_t index = 0;  ///< of the node that is next
    alignas(32) float keys[format::max_children];

    /// First half: which children are worth a visit.
    [[gnu::always_inline]] unsigned test(const BlobData& blob, Visitor& visitor) {
        return visitor.children(node_at(blob, index), keys);
    }

    /// Second half: visits leaves until it is a node's turn. False when the walk is over.
    [[gnu::always_inline]] bool advance(const BlobData& blob, Visitor& visitor, unsigned mask) {
        const Node tested = node_at(blob, index);
        const unsigned node_children = tested.node_children();
        const std::uint32_t first_child = tested.first_child();
        const unsigned nodes = mask & ((1u << node_children) - 1u);
        unsigned leaves = mask >> node_children;
        std::uint32_t parent = index;  // of the leaves
        if (nodes != 0) {
            if (leaves == 0 && lanes > 1) {  // one lane: a small core, to which less code is dearer than less time
                const auto child = static_cast<unsigned>(std::countr_zero(nodes));
                const unsigned others = nodes & (nodes - 1);
                if (others == 0) {  // most often: nothing to sort, and the next address does not wait for its key
                    index = first_child + child;
                    return true;
                }
                index = nearest_of(child, others, [&](unsigned number) {
                            prefetch(node_at(blob, first_child + number).bytes);
                            return first_child + number;
                        }).node();
                return true;
            }
            const auto child = static_cast<unsigned>(std::countr_zero(mask));
            const Waiting nearest = nearest_of(child, mask & (mask - 1), [&](unsigned number) {
                return number < node_children
                           ? first_child + number
                           : (index | Waiting::leaf_bit) + ((number - node_children) << Waiting::leaf_shift);
            });
            if (!nearest.is_leaf()) {
                index = nearest.node();
                return true;
            }
            leaves = 1u << nearest.leaf();
        }
        for (;;) {
            for (; leaves != 0; leaves &= leaves - 1) {
                const auto number = static_cast<unsigned>(std::countr_zero(leaves));
                if (parent == index && keys[node_children + number] > visitor.limit()) continue;
                if (visitor.visit_leaf(leaf_at<Leaf>(blob, node_at(blob, parent), number)) == stop) return false;
            }
            Waiting next;
            do {
                if (size == 0) return false;
                next = {stack[--size]};
            } while (!next.is_within(visitor.limit()));
            if (!next.is_leaf()) {
                index = next.node();
                return true;
            }
            parent = next.node();
            leaves = 1u << next.leaf();
        }
    }

private:
    /// The nearest of several children; the others are left waiting, the nearer ones on top. Compared and chosen as
    /// plain words: no processor could foresee branches here.
    template <class What>
    [[gnu::always_inline]] Waiting nearest_of(unsigned child, unsigned others, What what) {
        const auto entry_of = [&](unsigned number) {
            return std::uint64_t{std::bit_cast<std::uint32_t>(keys[number])} << 32 | what(number);
        };
        std::uint64_t nearest = entry_of(child);
        const unsigned bottom = size;
        for (; others != 0; others &= others - 1) {
            const std::uint64_t other = entry_of(static_cast<unsigned>(std::countr_zero(others)));
            const std::uint64_t waits = other < nearest ? nearest : other;
            nearest = other < nearest ? other : nearest;
            unsigned place = size++;
            for (; place > bottom && stack[place - 1] < waits; --place) stack[place] = stack[place - 1];
            stack[place] = waits;
        }
        return {nearest};
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
[[gnu::noinline]] Visit traverse_in_storage_order(const BlobData& blob, Visitor& visitor) {
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
