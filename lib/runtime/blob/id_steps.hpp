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
    const std::byte* last_word;  ///< the last eight bytes of the blob
    unsigned bit = 0;            ///< of the next field

    /// Returns the bits from the next field on, at least 57 of them unless the blob ends before.
    [[nodiscard]] std::uint64_t ahead() const {
        const std::byte* const at = bytes + bit / 8;
        if (at <= last_word) return load_u64(at) >> (bit % 8);
        return load_u64(last_word) >> (8 * static_cast<unsigned>(at - last_word) + bit % 8);
    }

    /// Returns the next `width` bits, at most 32. Reads no byte outside of the blob.
    std::uint32_t take(unsigned width) {
        if (takes_shortcut()) {
            const std::uint64_t field = ahead() & ((std::uint64_t{1} << width) - 1u);
            bit += width;
            return static_cast<std::uint32_t>(field);
        }
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
    std::uint32_t newest = 0;
    const std::byte* kind = nullptr;  ///< of the next step, once it is found

    IdWalk(const BlobData& of, std::uint32_t first_byte)
        : blob(of), fields{id_steps(of, first_byte), of.bytes + of.size - sizeof(std::uint64_t)} {}

    /// Begins with the block's first number.
    void begin() {
        const std::uint32_t first = fields.take(static_cast<unsigned>(std::bit_width(mask)));
        for (std::uint32_t& number : numbers_) number = first;
        newest = first;
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
        const std::uint32_t field = fields.take(load_u8(kind + format::ids::width_at));
        add(load_u8(kind + format::ids::from_at), load_u32(kind) + field, load_u8(kind + format::ids::replaced_at));
    }

    /// Finds and takes the next step, which there must be, in fewer loads: its bits and its kind are a word each.
    void step() {
        const std::uint64_t bits = fields.ahead();
        const std::uint64_t of_kind =
            load_u64(id_kind(blob, static_cast<std::uint32_t>(bits) & ((1u << blob.id_kind_bits) - 1u)));
        const auto part = [of_kind](std::size_t at) { return static_cast<unsigned>(of_kind >> (8 * at)) & 0xFFu; };
        const unsigned width = part(format::ids::width_at), prefix = part(format::ids::prefix_at);
        const auto field = static_cast<std::uint32_t>(bits >> prefix & ((std::uint64_t{1} << width) - 1u));
        fields.bit += prefix + width;
        add(part(format::ids::from_at), static_cast<std::uint32_t>(of_kind) + field, part(format::ids::replaced_at));
    }

private:
    /// Adds to the recent number at place `from`. That at place `replaced` gives way, and those before it move back: as
    /// places of `numbers_`, four bits each.
    void add(unsigned from, std::uint32_t distance, unsigned replaced) {
        const unsigned at = 4 * replaced;
        const std::uint32_t own = places_ >> at & 7u, before = places_ & ((1u << at) - 1u);
        newest = (numbers_[places_ >> 4 * from & 7u] + distance) & mask;
        places_ = static_cast<std::uint32_t>(places_ & ~((std::uint64_t{16} << at) - 1u)) | before << 4 | own;
        numbers_[own] = newest;
    }

    std::uint32_t numbers_[format::ids::recent_numbers];
    std::uint32_t places_ = 0x76543210;  ///< of the recent numbers, that of the newest in the lowest bits
};

/// The number of a triangle that there is. At most 127 steps.
inline std::uint32_t number_of(const BlobData& blob, std::uint32_t triangle) {
    const std::byte* const block = id_block(blob, triangle / format::ids::block_triangles);
    IdWalk walk(blob, load_u32(block));
    walk.begin();
    for (std::uint32_t left = triangle % format::ids::block_triangles; left != 0; --left) {
        if (takes_shortcut()) {
            walk.step();
        } else {
            walk.find_kind();
            walk.take_step();
        }
    }
    return walk.newest;
}

}  // namespace espalier::detail
