// The vertices of one plain leaf, moved to their positions.
#pragma once

#include <runtime/blob/tree_cost.hpp>
#include <runtime/deformation/pose_axis.hpp>

namespace espalier::detail {

/// The rows of a leaf that moves, and the numbers of its vertices in the sources.
struct MovingLeaf {
    std::byte* words;
    std::byte* high_bytes;  ///< null if coordinates have no more than the words
    const std::byte* sources;
    unsigned vertex_count;
    bool has_short_sources;

    [[nodiscard]] std::size_t source(unsigned vertex) const {
        return has_short_sources ? load_u16(sources + 2 * std::size_t{vertex})
                                 : load_u32(sources + 4 * std::size_t{vertex});
    }
};

/// Writes the coordinates of each vertex. Returns the box around them.
template <bool near>
inline UnsignedBox place_one_by_one(const PoseAxes& axes, const Vec3* positions, const MovingLeaf& leaf) {
    UnsignedBox box;
    for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex) {
        const Vec3& position = positions[leaf.source(vertex)];
        const auto place = [&](unsigned k, float number) ESPALIER_ALWAYS_INLINE_LAMBDA {
            const std::uint32_t coordinate = axes.axis[k].coordinate<near>(number);
            const std::size_t at = std::size_t{k} * leaf.vertex_count + vertex;
            store_u16(leaf.words + 2 * at, coordinate & 0xFFFFu);
            if (leaf.high_bytes != nullptr) store_u8(leaf.high_bytes + at, coordinate >> 16);
            box.low[k] = coordinate < box.low[k] ? coordinate : box.low[k];
            box.high[k] = coordinate > box.high[k] ? coordinate : box.high[k];
        };
        place(0, position.x);
        place(1, position.y);
        place(2, position.z);
    }
    return box;
}

/// Places at least four vertices on near axes, four at a time. If their number is no multiple of four, the last four
/// overlap the ones before.
template <bool has_short_sources, bool has_high_bytes>
inline UnsignedBox place_by_fours(const PoseAxes& axes, const Vec3* positions, const MovingLeaf& leaf) {
    FourFloats low[3], high[3];
    for (int k = 0; k < 3; ++k) {
        low[k] = FourFloats{} + 0x1p25f;  // above and below all sums
        high[k] = FourFloats{};
    }
    const std::size_t row = leaf.vertex_count, last = row - 4;
    for (std::size_t first = 0;; first = first + 4 < last ? first + 4 : last) {
        const auto position = [&](std::size_t i) {
            const std::size_t vertex = first + i;
            return positions + std::size_t{has_short_sources ? load_u16(leaf.sources + 2 * vertex)
                                                             : load_u32(leaf.sources + 4 * vertex)};
        };
        const FourPositions four(position(0), position(1), position(2), position(3));
        FourWords coordinates[3];
        for (unsigned k = 0; k < 3; ++k) {
            const FourFloats sums = four_sums(axes.axis[k], four.axis[k]);
            low[k] = sums < low[k] ? sums : low[k];
            high[k] = sums > high[k] ? sums : high[k];
            coordinates[k] = std::bit_cast<FourWords>(sums) - axes.axis[k].zero_bits;
            if constexpr (has_high_bytes) {
                const FourWords above = coordinates[k] >> 16;
                const std::uint32_t bytes = above[0] | above[1] << 8 | above[2] << 16 | above[3] << 24;
                ESPALIER_COPY_BYTES(leaf.high_bytes + (k * row + first), &bytes, sizeof bytes);
            }
        }
        std::byte* const words = leaf.words + 2 * first;
        store_low_words(words, coordinates[0], words + 2 * row, coordinates[1]);
        store_low_words(words + 4 * row, coordinates[2], words + 4 * row, coordinates[2]);
        if (first == last) break;
    }
    UnsignedBox box;
    for (int k = 0; k < 3; ++k) {
        const float least = minimum(minimum(low[k][0], low[k][1]), minimum(low[k][2], low[k][3]));
        const float most = maximum(maximum(high[k][0], high[k][1]), maximum(high[k][2], high[k][3]));
        box.low[k] = std::bit_cast<std::uint32_t>(least) - axes.axis[k].zero_bits;
        box.high[k] = std::bit_cast<std::uint32_t>(most) - axes.axis[k].zero_bits;
    }
    return box;
}

template <bool near>
inline UnsignedBox place_vertices(const PoseAxes& axes, const Vec3* positions, const MovingLeaf& leaf) {
    if constexpr (near && takes_four_positions) {
        if (leaf.vertex_count >= 4)
            return leaf.high_bytes == nullptr ? leaf.has_short_sources
                                                    ? place_by_fours<true, false>(axes, positions, leaf)
                                                    : place_by_fours<false, false>(axes, positions, leaf)
                   : leaf.has_short_sources ? place_by_fours<true, true>(axes, positions, leaf)
                                              : place_by_fours<false, true>(axes, positions, leaf);
    }
    return place_one_by_one<near>(axes, positions, leaf);
}

}  // namespace espalier::detail
