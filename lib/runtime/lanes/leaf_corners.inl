// The vertices of a leaf and which of them its triangles have, `lanes` at a time. Lanes of unused slots and vertices
// hold any number; look_up accepts them.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/blob/alone.hpp>
static_assert(true);  // ends clangd's preamble, which cannot include this file
#include <runtime/lanes/scalar.hpp>
using scalar::CornerNumbers, scalar::Ints, scalar::lanes, scalar::StripCorners;
using scalar::load_bytes, scalar::load_numbers, scalar::load_words, scalar::unpack, scalar::with_high_bytes;
#endif

/// Coordinates of `lanes` vertices along an axis, counted from the leaf's anchor. `load_width` returns a width as
/// given.
template <class LoadWidth>
[[gnu::always_inline]] inline Ints offsets_of(const StripLeaf& leaf, unsigned axis, unsigned group,
                                              LoadWidth load_width) {
    return unpack(leaf.coordinates[axis], load_width(leaf.width[axis]), group * lanes);
}
template <class LoadWidth>
[[gnu::always_inline]] inline Ints offsets_of(const PlainLeaf& leaf, unsigned axis, unsigned group, LoadWidth) {
    const std::size_t place = std::size_t{axis} * leaf.vertex_count + std::size_t{group} * lanes;
    const Ints words = load_words(leaf.words() + 2 * place);
    return leaf.has_high_bytes() ? with_high_bytes(words, load_bytes(leaf.high_bytes() + place)) : words;
}
template <class Leaf>
[[gnu::always_inline]] inline Ints offsets_of(const Leaf& leaf, unsigned axis, unsigned group) {
    return offsets_of(leaf, axis, group, [](unsigned width) { return width; });
}

class PlainCorners {
public:
    explicit PlainCorners(const PlainLeaf& leaf) : row_(leaf.corner_row), row_bytes_(leaf.slot_count) {}
    [[gnu::always_inline]] CornerNumbers next() {
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
