// Strips of profile `tiny`: most vertices are stored as what they differ by from a prediction, so a leaf is decoded as
// a whole. The layout is in format/leaves.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/strip_leaf.hpp>

namespace espalier::detail {

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
