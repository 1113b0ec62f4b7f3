// What nodes of all kinds store alike: their children in one word, rows of planes, and where their leaves lie.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>

namespace espalier::detail {

/// The bytes of a node, by the places that its layout gives.
template <std::size_t place_of_children, std::size_t leaf_block_at, std::size_t low_at, std::size_t high_at,
          std::size_t row_bytes>
struct NodeBytes {
    static constexpr std::size_t children_at = place_of_children;

    const std::byte* bytes;

    [[nodiscard, gnu::always_inline]] std::uint32_t first_child() const {
        return load_u32(bytes + children_at) & 0xFFFFFFu;
    }
    [[nodiscard]] const std::byte* low_planes(int axis) const {
        return bytes + low_at + row_bytes * static_cast<std::size_t>(axis);
    }
    [[nodiscard]] const std::byte* high_planes(int axis) const {
        return bytes + high_at + row_bytes * static_cast<std::size_t>(axis);
    }
    /// Where the block of its leaves starts, in units of 4 bytes.
    [[nodiscard]] std::uint32_t leaf_block_place() const { return load_u32(bytes + leaf_block_at); }
    [[nodiscard]] const std::byte* leaf_block(const BlobData& blob) const {
        return blob.leaves + 4 * std::size_t{leaf_block_place()};
    }
};

}  // namespace espalier::detail
