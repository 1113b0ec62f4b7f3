// Triangles with copies in several leaves: which of them all is meant.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

inline const std::byte* copy_block(const std::byte* copies, std::uint32_t index) {
    return copies + format::copies::blocks_at +
           std::size_t{index / format::copies::block_indices} * format::copies::block_bytes;
}

/// A u32 for each copy, behind the last block.
inline const std::byte* copy_owners(const BlobData& blob) {
    return blob.copies + format::copies::blocks_at +
           std::size_t{format::copies::block_count(blob.triangle_count)} * format::copies::block_bytes;
}

/// For the section `copies` of a blob that has one.
ESPALIER_SHARED_CODE inline bool is_duplicate_reference(const std::byte* copies, std::uint32_t index) {
    const std::uint32_t bit = index % format::copies::block_indices;
    return (load_u8(copy_block(copies, index) + format::copies::bits_at + bit / 8) >> (bit % 8) & 1u) != 0;
}
inline bool is_duplicate_reference(const BlobData& blob, std::uint32_t index) {
    // mutant(without 1) equivalent: the build for mutants reads all sections
    return reads(format::feature::split_references) && blob.copies != nullptr &&
           is_duplicate_reference(blob.copies, index);
}

/// The storage index that stands for the triangle: the lowest one it has. O(1).
ESPALIER_SHARED_CODE inline std::uint32_t owner_of(const BlobData& blob, std::uint32_t index) {
    if (!is_duplicate_reference(blob, index)) return index;
    const std::byte* block = copy_block(blob.copies, index);
    const std::uint32_t bit = index % format::copies::block_indices;
    std::uint32_t copies_before = load_u32(block);
    for (std::uint32_t word = 0; word <= bit / 32; ++word) {
        const std::uint32_t before = word < bit / 32 ? ~0u : (1u << bit % 32) - 1u;
        copies_before += count_bits(load_u32(block + format::copies::bits_at + 4 * word) & before);
    }
    return load_u32(copy_owners(blob) + format::copies::owner_bytes * std::size_t{copies_before});
}

}  // namespace espalier::detail
