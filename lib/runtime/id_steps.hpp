// The section of original ids: from a block's first triangle step by step to the one that is wanted.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/bytes.hpp>
#include <runtime/leaf_kinds.hpp>

namespace espalier::detail {

/// Known at compile time where one kind of leaves is read.
inline std::uint32_t corner_factor(const BlobData& blob) {
    return has_indexed_leaves(blob.profile) ? 1 : format::ids::corner_factor(format::Profile::balanced);
}

/// Numbers are below this. `open` proves that it fits.
inline std::uint32_t number_limit(const BlobData& blob) { return corner_factor(blob) * blob.source_triangles; }

/// The parts of the section, which must be there.
inline const std::byte* id_kind(const BlobData& blob, std::uint32_t kind) {
    return blob.ids + format::ids::kind_bytes * std::size_t{kind};
}
inline const std::byte* id_block(const BlobData& blob, std::uint32_t block) {
    return id_kind(blob, 1u << blob.id_kind_bits) + format::ids::block_bytes * std::size_t{block};
}
inline const std::byte* id_steps(const BlobData& blob, std::uint32_t first_byte) {
    return id_block(blob, format::ids::block_count(blob.triangle_count)) + first_byte;
}

/// Reads the fields of a block's steps one after the other.
struct StepFields {
    const std::byte* bytes;
    unsigned bit = 0;  ///< of the next field

    /// Returns the next `width` bits, at most 32. Reads the bytes that they lie in, no other.
    std::uint32_t take(unsigned width) {
        std::uint32_t field = 0;
        for (unsigned done = 0; done < width;) {
            const unsigned first = bit % 8, left = width - done;
            // mutant(< -> <=) equivalent: both sides are equal then
            const unsigned count = left < 8 - first ? left : 8 - first;
            field |= ((load_u8(bytes + bit / 8) >> first) & ((1u << count) - 1u)) << done;
            done += count;
            bit += count;
        }
        return field;
    }
};

/// The number after `number`, by a step of this kind and its field. `number_mask` is 2^number_bits - 1.
inline std::uint32_t after_step(std::uint32_t number, const std::byte* kind, std::uint32_t field,
                                std::uint32_t number_mask) {
    // mutant(+ -> - 2, + -> right side dropped 2) equivalent: offset_at is 0
    return (number + load_u32(kind + format::ids::offset_at) + field) & number_mask;
}

/// 2^number_bits - 1: the smallest mask that holds every number.
inline std::uint32_t number_mask(const BlobData& blob) {
    const std::uint32_t limit = number_limit(blob);
    // mutant(<= -> <) sanitizer: shifts by the width of the type, and every number is 0 then
    return limit <= 1 ? 0 : ~std::uint32_t{0} >> std::countl_zero(limit - 1);
}

/// The number of a triangle that there is. At most 127 steps.
inline std::uint32_t number_of(const BlobData& blob, std::uint32_t triangle) {
    const std::byte* const block = id_block(blob, triangle / format::ids::block_triangles);
    const std::uint32_t mask = number_mask(blob);
    // mutant(+ -> -, + -> right side dropped) equivalent: number_at is 0
    std::uint32_t number = load_u32(block + format::ids::number_at);
    StepFields steps = {id_steps(blob, load_u32(block + format::ids::steps_at))};
    for (std::uint32_t left = triangle % format::ids::block_triangles; left != 0; --left) {
        const std::byte* const kind = id_kind(blob, steps.take(blob.id_kind_bits));
        number = after_step(number, kind, steps.take(load_u32(kind + format::ids::width_at)), mask);
    }
    return number;
}

}  // namespace espalier::detail
