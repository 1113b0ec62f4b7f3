// Which vertices the triangles of a leaf have, `lanes` slots at a time. Included inside the namespace of each
// instruction set. What a lane says of a slot that is not used means nothing, but look_up may be asked it.

class IndexedCorners {
public:
    explicit IndexedCorners(const IndexedLeaf& leaf) : leaf_(leaf) {}
    [[gnu::always_inline]] CornerNumbers next() {
        const Ints corners = unpack(leaf_.triangles, 3 * leaf_.corner_width, first_);
        first_ += lanes;
        return {corner_of(corners, 0, leaf_.corner_width), corner_of(corners, 1, leaf_.corner_width),
                corner_of(corners, 2, leaf_.corner_width)};
    }

private:
    const IndexedLeaf& leaf_;
    unsigned first_ = 0;
};

inline IndexedCorners corners_of(const IndexedLeaf& leaf) { return IndexedCorners(leaf); }
inline StripCorners corners_of(const StripLeaf& leaf) { return StripCorners(leaf); }

inline std::uint32_t storage_index(const IndexedLeaf& leaf, unsigned slot) {
    return first_triangle_in_lanes(leaf) + slot;
}
inline std::uint32_t storage_index(const StripLeaf& leaf, unsigned slot) {
    const StripLeaf::Slots before = leaf.windows & ((StripLeaf::Slots{1} << slot) - 1);
    return leaf.first + static_cast<std::uint32_t>(std::popcount(before));
}
/// The storage index that stands for the triangle in a slot.
template <class Leaf>
inline std::uint32_t owner_index(const Leaf& leaf, unsigned slot) {
    const std::uint32_t index = storage_index(leaf, slot);
    if constexpr (Leaf::may_have_copies) return owner_of(*leaf.blob, index);
    else return index;
}
