// The section of original ids: from a block's first triangle step by step to the one that is wanted.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>

namespace espalier::detail {

/// Known at compile time where one kind of leaves is read.
inline std::uint32_t corner_factor(const BlobData& blob) {
    return has_plain_leaves(blob.profile) ? 1 : format::ids::corner_factor(Profile::balanced);
}

/// Numbers are below this. `open` proves that it fits.
inline std::uint32_t number_limit(const BlobData& blob) { return corner_factor(blob) * blob.source_triangles; }

/// The parts of the section, which must be there.
inline const std::byte* id_kind(const BlobData& blob, std::uint32_t kind) {
    return blob.ids + format::ids::kind_bytes * std::size_t{kind};
}
inline const std::byte* id_steps(const BlobData& blob, std::uint32_t first_byte) {
    return id_kind(blob, 1u << blob.id_kind_bits) + first_byte;
}
inline const std::byte* id_block(const BlobData& blob, std::uint32_t block) {
    const std::size_t step_bytes = load_u32(blob.bytes + format::header::id_step_bytes_at);
    return id_steps(blob, 0) + (step_bytes + 3) / 4 * 4 + format::ids::block_bytes * std::size_t{block};
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

/// 2^number_bits - 1: the smallest mask that holds every number.
ESPALIER_SHARED_CODE inline std::uint32_t number_mask(const BlobData& blob) {
    const std::uint32_t limit = number_limit(blob);
    return limit <= 1 ? 0 : ~std::uint32_t{0} >> std::countl_zero(limit - 1);
}

/// Goes through the numbers of a block.
struct IdWalk {
    const BlobData& blob;
    StepFields fields;
    std::uint32_t mask = number_mask(blob);
    std::uint32_t recent[format::ids::recent_numbers];  ///< the newest first
    const std::byte* kind = nullptr;                    ///< of the next step, once it is found

    IdWalk(const BlobData& of, std::uint32_t first_byte) : blob(of), fields{id_steps(of, first_byte)} {}

    /// Begins with the block's first number.
    void begin() {
        const std::uint32_t first = fields.take(static_cast<unsigned>(std::bit_width(mask)));
        for (std::uint32_t& number : recent) number = first;
    }

    /// Finds the kind of the next step by the bits that it begins with; returns the bits of the whole step. Its prefix
    /// may be shorter than what is read, so this reads up to id_kind_bits behind the step, where blocks follow.
    unsigned find_kind() {
        StepFields ahead = fields;
        kind = id_kind(blob, ahead.take(blob.id_kind_bits));
        return load_u8(kind + format::ids::prefix_at) + load_u8(kind + format::ids::width_at);
    }

    /// Takes the step of the kind that was found.
    void take_step() {
        static_assert(format::ids::offset_at == 0);
        fields.bit += load_u8(kind + format::ids::prefix_at);
        const std::uint32_t number = recent[load_u8(kind + format::ids::from_at)] + load_u32(kind) +
                                     fields.take(load_u8(kind + format::ids::width_at));
        for (unsigned place = load_u8(kind + format::ids::replaced_at); place != 0; --place)
            recent[place] = recent[place - 1];
        recent[0] = number & mask;
    }
};

/// The number of a triangle that there is. At most 127 steps.
inline std::uint32_t number_of(const BlobData& blob, std::uint32_t triangle) {
    const std::byte* const block = id_block(blob, triangle / format::ids::block_triangles);
    IdWalk walk(blob, load_u32(block));
    walk.begin();
    for (std::uint32_t left = triangle % format::ids::block_triangles; left != 0; --left) {
        walk.find_kind();
        walk.take_step();
    }
    return walk.recent[0];
}

}  // namespace espalier::detail
