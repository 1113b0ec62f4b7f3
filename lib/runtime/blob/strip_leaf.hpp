// The leaves of profiles `balanced`, `small` and `tiny`, decoded: strips of triangles, each vertex stored once. The
// layout is in format/leaves.hpp. Strips that turn either way by a bit go back to Deering (1995); that the pivot is the
// last one marked is what lets all windows be decoded at once.
#pragma once

#include <array>

#include <runtime/blob/node.hpp>

namespace espalier::detail {

struct StripLeaf;
/// The storage index of the first triangle of a predicted strip.
std::uint32_t first_of_predicted(const StripLeaf& leaf);

/// One leaf: where its streams are and how wide their fields. Its slots are its windows.
struct StripLeaf : LeafVertices<PackedNode> {
    using Slots = std::uint64_t;  ///< a bit for each slot
    static constexpr unsigned max_vertices = format::strip_leaf::max_small_entries;
    static_assert(max_vertices == format::predicted_strip::max_vertices);
    static constexpr unsigned max_slots =
        (reads_predicted_strips ? format::predicted_strip::max_entries : format::strip_leaf::max_small_entries) - 2;
    static constexpr bool may_have_duplicates = false;
    static constexpr bool counts_from_zero = false;

    const std::byte* coordinates[3];
    std::int32_t anchors[3];  ///< the low corner of its box
    std::uint8_t width[3];    ///< of a coordinate, in bits
    std::uint8_t slot_count;
    std::uint8_t references_at;  ///< in bits, in the marks
    std::uint8_t reference_width;
#if ESPALIER_PREDICTED_STRIPS
    union {
        std::uint32_t stored_first;  ///< storage index of the first triangle, where it is stored
        /// In bits, in the data of a predicted strip.
        struct {
            std::uint16_t choices_at;
            std::uint16_t numbers_at;
        } predicted;
    };
#else
    std::uint32_t stored_first;  ///< storage index of the first triangle
#endif
    const std::byte* marks;  ///< its data
    // A bit for each entry or window.
    std::uint64_t pivots;
    std::uint64_t windows;
    std::uint64_t first_uses;

    [[nodiscard]] Slots used_slots() const { return windows; }
    [[nodiscard]] unsigned triangle_count() const { return static_cast<unsigned>(std::popcount(windows)); }
    [[nodiscard]] unsigned entry_count() const { return slot_count + 2; }

    [[nodiscard]] bool is_predicted() const { return has_predicted_leaves(blob->profile); }
    /// The storage index of its first triangle.
    [[nodiscard]] std::uint32_t first() const {
        if constexpr (reads_predicted_strips)
            if (is_predicted()) return first_of_predicted(*this);
        return stored_first;
    }

    [[nodiscard]] std::int32_t anchor(int axis) const { return anchors[axis]; }
    [[nodiscard]] std::int32_t offset(int axis, unsigned vertex) const {
        return static_cast<std::int32_t>(load_field(coordinates[axis], width[axis], vertex));
    }
    /// Every coordinate lies behind it by less than 2^grid_bits().
    [[nodiscard]] std::int32_t grid_base(int axis) const { return anchor(axis); }
    [[nodiscard]] int grid_bits() const { return size_bits; }

    /// The vertex that an entry names.
    [[nodiscard]] ESPALIER_SHARED_CODE unsigned entry(unsigned place) const {
        const std::uint64_t before = (std::uint64_t{1} << place) - 1;
        const unsigned fresh = count_bits(first_uses & before);
        if ((first_uses >> place & 1) != 0) return fresh;
        const unsigned reference = place - fresh;
        return load_few_bits(marks, references_at + reference * reference_width, reference_width);
    }
    /// The entries that are a triangle's corners.
    [[nodiscard]] ESPALIER_ALWAYS_INLINE std::array<unsigned, 3> window(unsigned slot) const {
        const std::uint64_t behind = pivots & ((std::uint64_t{2} << slot) - 1);
        const unsigned pivot = static_cast<unsigned>(std::bit_width(behind)) - 1;
        // Each turn of a strip changes the order in which its entries go round the triangle.
        // mutant(+ -> - 1) equivalent: both sums are even or both are odd
        const unsigned turned = (count_bits(behind) + 1) % 2;
        return {pivot, slot + 1 + turned, slot + 2 - turned};
    }
    /// The vertex that is a triangle's corner 0, 1 or 2.
    [[nodiscard]] unsigned corner(unsigned slot, unsigned which) const { return entry(window(slot)[which]); }
    [[nodiscard]] ESPALIER_SHARED_CODE LeafCorners corners(unsigned slot) const {
        const auto places = window(slot);
        return {entry(places[0]), entry(places[1]), entry(places[2])};
    }
    [[nodiscard]] ESPALIER_SHARED_CODE LatticeTriangle triangle(unsigned slot) const {
        return triangle_of(*this, corners(slot));
    }
};

/// Takes the width of offsets in the leaf's box on an axis from the node.
ESPALIER_ALWAYS_INLINE inline unsigned decode_axis(StripLeaf& leaf, int axis) {
    const PackedNode& node = leaf.node;
    const unsigned bits = leaf.blob->bits;
    const unsigned child = leaf.child();
    const std::uint32_t low = load_u8(node.low_planes(axis) + child);
    const std::uint32_t planes = load_u8(node.high_planes(axis) + child) - low;
    const unsigned shift = node.shift(axis);
    const unsigned width = format::strip_leaf::coordinate_width(planes << shift, bits);
    leaf.width[axis] = static_cast<std::uint8_t>(width);
    leaf.anchors[axis] = node.base(axis, bits) + static_cast<std::int32_t>(low << shift);
    return width;
}

/// The leaf that is child `node.node_children() + number` of the node, of a profile that stores vertices.
ESPALIER_SHARED_OR_PART_OF_CALLER inline void decode_leaf(const BlobData& blob, PackedNode node, unsigned number,
                                                          StripLeaf& leaf) {
    using namespace format::strip_leaf;
    leaf.node = node;
    leaf.number = static_cast<std::uint8_t>(number);
    leaf.blob = &blob;
    const std::byte* const block = node.leaf_block(blob);
    const std::uint32_t descriptor = load_u32(block + descriptors_at + descriptor_bytes * std::size_t{number});
    // mutant(<< -> one less) equivalent: seven of the largest strips end below half the range of an offset, and open
    // checks all bits
    leaf.marks = block + descriptors_at + descriptor_bytes * std::size_t{node.leaf_children()} +
                 (descriptor & ((1u << offset_bits) - 1u));
    leaf.stored_first = load_u32(block) + (descriptor >> first_shift & 511u);
    const unsigned marked = descriptor >> entries_shift & 63u;
    leaf.slot_count = static_cast<std::uint8_t>(marked + 1);
    leaf.pivots = load_bits(leaf.marks, 0, marked) << 1 | 1u;
    leaf.windows = load_bits(leaf.marks, marked, marked) << 1 | 1u;
    leaf.first_uses = load_bits(leaf.marks, 2 * marked, marked) << 3 | 7u;
    leaf.vertex_count = static_cast<std::uint8_t>(std::popcount(leaf.first_uses));
    leaf.references_at = static_cast<std::uint8_t>(3 * marked);
    leaf.reference_width = static_cast<std::uint8_t>(reference_width(leaf.vertex_count));
    const std::byte* at = leaf.marks + (mark_bits(marked + 3, leaf.vertex_count) + 7) / 8;
    const std::uint32_t vertex_count = leaf.vertex_count;
    std::uint32_t longest = 0;
    for (int k = 0; k < 3; ++k) {
        const unsigned width = decode_axis(leaf, k);
        leaf.coordinates[k] = at;
        at += (vertex_count * width + 7) / 8;
        // mutant(> -> >=) equivalent: both sides are equal then
        longest = width > longest ? width : longest;
    }
    leaf.size_bits = static_cast<std::uint8_t>(longest);
}

// Strips of profile `tiny`: most vertices are stored as what they differ by from a prediction, so a leaf is decoded as
// a whole.

#if ESPALIER_PREDICTED_STRIPS

inline unsigned joint_count(const std::byte* data) {
    using namespace format::predicted_strip;
    return load_few_bits(data, joints_at, joint_count_bits);
}

/// The widths of a predicted strip's residuals.
struct ResidualWidths {
    unsigned large[3], small[3];

    explicit ResidualWidths(const StripLeaf& leaf) {
        using namespace format::predicted_strip;
        const std::uint64_t widths = load_bits(leaf.marks, 0, joints_at);
        for (unsigned k = 0; k < 3; ++k) {
            large[k] = static_cast<unsigned>(widths >> (2 * width_bits * k)) & 31u;
            small[k] = static_cast<unsigned>(widths >> (2 * width_bits * k + width_bits)) & 31u;
        }
    }
};

/// The vertices of a predicted strip, decoded, as other strips store theirs.
struct PredictedVertices {
    static constexpr unsigned width = format::max_bits;
    static constexpr unsigned row_bytes = format::predicted_strip::max_vertices / 8 * width;

    std::byte rows[3 * row_bytes + format::guard_bytes];

    [[nodiscard]] std::byte* at(unsigned axis, unsigned vertex) { return rows + axis * row_bytes + 3 * vertex; }
    [[nodiscard]] std::uint32_t get(unsigned axis, unsigned vertex) {
        return load_few_bits(at(axis, vertex), 0, width);
    }
    void set(unsigned axis, unsigned vertex, std::uint32_t point) {
        std::byte* const to = at(axis, vertex);
        for (unsigned byte = 0; byte < 3; ++byte) to[byte] = static_cast<std::byte>(point >> (8 * byte));
    }
};

/// Makes vertices what the coordinates of a leaf are read from.
inline void use_vertices(PredictedVertices& vertices, StripLeaf& leaf) {
    for (unsigned k = 0; k < 3; ++k) {
        leaf.coordinates[k] = vertices.at(k, 0);
        leaf.width[k] = PredictedVertices::width;
    }
}

/// Decodes all of a predicted strip but its vertices. Reads no more than 48 bytes of its data, whatever they are.
void decode_predicted_marks(const BlobData& blob, PackedNode node, unsigned number, StripLeaf& leaf);

/// Decodes the vertices of a leaf, whose marks are decoded and whose numbers are inside the blob. Returns whether all
/// are as far from the anchor as its widths reach, without which they are not kept as a whole.
bool decode_predicted_vertices(const StripLeaf& leaf, PredictedVertices& vertices);

/// Stores the vertices of such a leaf in whole words, axis by axis.
void store_predicted_vertices(const StripLeaf& leaf, std::uint32_t* x, std::uint32_t* y, std::uint32_t* z);

/// Decodes the predicted strip that is child `node.node_children() + number` of the node. The leaf refers to the
/// vertices.
void decode_predicted_strip(const BlobData& blob, PackedNode node, unsigned number, StripLeaf& leaf,
                            PredictedVertices& vertices);

/// A strip with room for its vertices, where those are predicted.
struct StripWithVertices : StripLeaf {
    PredictedVertices vertices;

    StripWithVertices() {}  // NOLINT(modernize-use-equals-default): no member has a value yet
    StripWithVertices(const StripWithVertices&) = delete;
    StripWithVertices& operator=(const StripWithVertices&) = delete;
};
ESPALIER_ALWAYS_INLINE inline void decode_leaf(const BlobData& blob, PackedNode node, unsigned number,
                                               StripWithVertices& leaf) {
    if (has_predicted_leaves(blob.profile)) return decode_predicted_strip(blob, node, number, leaf, leaf.vertices);
    decode_leaf(blob, node, number, static_cast<StripLeaf&>(leaf));
}

/// A leaf that a frame keeps while it is read.
template <class Leaf>
using KeptLeaf = std::conditional_t<std::is_same_v<Leaf, StripLeaf>, StripWithVertices, Leaf>;

#else

template <class Leaf>
using KeptLeaf = Leaf;

#endif

}  // namespace espalier::detail
