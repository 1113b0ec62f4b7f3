// Leaves: which kind a blob has, one decoded for a function, and its vertices and triangles, `lanes` at a time. Lanes
// of unused slots and vertices hold any number; look_up accepts them.

/// Calls the function for the kind of leaf that the blob has.
template <class Function>
ESPALIER_ALWAYS_INLINE inline auto with_leaves_of(const BlobData& blob, Function function) {
    if constexpr (!reads_strip_leaves) return function.template operator()<PlainLeaf>();
    else if constexpr (!reads_plain_leaves) return function.template operator()<StripLeaf>();
    else if (has_plain_leaves(blob.profile)) return function.template operator()<PlainLeaf>();
    else return function.template operator()<StripLeaf>();
}

#if ESPALIER_PREDICTED_STRIPS
/// Calls the function with a predicted strip. Apart from its caller, whose frame has no room for vertices.
template <class Function>
ESPALIER_NOINLINE inline auto with_predicted_strip(const BlobData& blob, PackedNode node, unsigned number,
                                                   Function& function) {
    StripLeaf leaf;
    PredictedVertices vertices;
    decode_predicted_strip(blob, node, number, leaf, vertices);
    return function(static_cast<const StripLeaf&>(leaf));
}
#endif

/// Calls the function with the leaf of a kind that is child `node.node_children() + number` of the node.
template <class Leaf, class Function>
ESPALIER_ALWAYS_INLINE inline auto with_leaf(const BlobData& blob, typename Leaf::Node node, unsigned number,
                                             Function function) {
#if ESPALIER_PREDICTED_STRIPS
    if constexpr (std::is_same_v<Leaf, StripLeaf>)
        if (has_predicted_leaves(blob.profile)) return with_predicted_strip(blob, node, number, function);
#endif
    return function(static_cast<const Leaf&>(leaf_at<Leaf>(blob, node, number)));
}

/// Has the visitor visit the leaf that is child `node.node_children() + number` of the node, or its place.
template <class Leaf, class Visitor>
ESPALIER_ALWAYS_INLINE inline Visit visit_leaf(const BlobData& blob, typename Leaf::Node node, unsigned number,
                                               Visitor& visitor) {
    if constexpr (std::is_same_v<Leaf, PlaceOf<Leaf>>) return visitor.visit_leaf(Leaf{&blob, node, number});
    else
        return with_leaf<Leaf>(blob, node, number, [&](const Leaf& leaf) ESPALIER_ALWAYS_INLINE_LAMBDA {
            return visitor.visit_leaf(leaf);
        });
}

struct AsGiven {
    unsigned operator()(unsigned width) const { return width; }
};
/// Coordinates of `lanes` vertices along an axis, counted from the leaf's anchor. `load_width` returns a width as
/// given.
template <class LoadWidth = AsGiven>
ESPALIER_ALWAYS_INLINE inline Ints offsets_of(const StripLeaf& leaf, unsigned axis, unsigned group,
                                              LoadWidth load_width = {}) {
    return unpack(leaf.coordinates[axis], load_width(leaf.width[axis]), group * lanes);
}
template <class LoadWidth = AsGiven>
ESPALIER_ALWAYS_INLINE inline Ints offsets_of(const PlainLeaf& leaf, unsigned axis, unsigned group, LoadWidth = {}) {
    const std::size_t place = std::size_t{axis} * leaf.vertex_count + std::size_t{group} * lanes;
    const Ints words = load_words(leaf.words() + 2 * place);
    return leaf.has_high_bytes() ? with_high_bytes(words, load_bytes(leaf.high_bytes() + place)) : words;
}

class PlainCorners {
public:
    explicit PlainCorners(const PlainLeaf& leaf) : row_(leaf.corner_row), row_bytes_(leaf.slot_count) {}
    ESPALIER_ALWAYS_INLINE CornerNumbers next() {
        const std::byte* const row = row_;
        row_ += lanes;
        return {load_numbers(row), load_numbers(row + row_bytes_), load_numbers(row + 2 * row_bytes_)};
    }

private:
    const std::byte* row_;
    std::size_t row_bytes_;
};

inline PlainCorners corners_of(const PlainLeaf& leaf) { return PlainCorners(leaf); }
inline StripCorners corners_of(const StripLeaf& leaf) { return StripCorners(leaf); }

inline std::uint32_t storage_index(const PlainLeaf& leaf, unsigned slot) { return leaf.first() + slot; }
inline std::uint32_t storage_index(const StripLeaf& leaf, unsigned slot) {
    const StripLeaf::Slots before = leaf.windows & ((StripLeaf::Slots{1} << slot) - 1);
    return leaf.first() + static_cast<std::uint32_t>(std::popcount(before));
}
/// The storage index that stands for the triangle in a slot.
template <class Leaf>
inline std::uint32_t owner_index(const Leaf& leaf, unsigned slot) {
    const std::uint32_t index = storage_index(leaf, slot);
    if constexpr (Leaf::may_have_duplicates) return owner_of(*leaf.blob, index);
    else return index;
}

/// Calls the function with the size of the smallest table that has room for so many vertices: this many groups of
/// `lanes`. With four lanes sizes are powers of two, as the numbers of the vertices can name, or that of the largest
/// leaf.
template <unsigned max_vertices,
          unsigned groups = (lanes > 4   ? 1
                             : lanes > 1 ? 2
                                         : max_vertices),
          class Function>
ESPALIER_ALWAYS_INLINE constexpr auto with_table_groups(unsigned vertex_count, Function function) {
    constexpr unsigned next = lanes > 4 ? groups + 1 : groups < 8 ? 2 * groups : 14;
    if constexpr (groups * lanes >= max_vertices) return function(std::integral_constant<unsigned, groups>{});
    else if (vertex_count <= groups * lanes) return function(std::integral_constant<unsigned, groups>{});
    else return with_table_groups<max_vertices, next>(vertex_count, function);
}
