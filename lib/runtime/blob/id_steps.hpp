// The section of original ids: from a block's first triangle step by step to the one that is wanted.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// Known at compile time where one kind of leaves is read.
inline std::uint32_t corner_factor(const BlobData& blob) {
    return has_plain_leaves(blob.profile) ? 1 : format::ids::corner_factor(Profile::balanced);
}

/// Numbers are below this. `open` proves that it fits.
inline std::uint32_t number_limit(const BlobData& blob) { return corner_factor(blob) * blob.source_triangles; }

inline bool has_runs(const BlobData& blob) { return (blob.features & format::feature::id_runs) != 0; }

/// The parts of the section, which must be there.
inline const std::byte* id_kind(const BlobData& blob, std::uint32_t kind) {
    return blob.ids + format::ids::kind_bytes * std::size_t{kind};
}
inline const std::byte* id_steps(const BlobData& blob, std::uint32_t first_byte) {
    return id_kind(blob, 1u << blob.id_kind_bits) + first_byte;
}
inline const std::byte* id_block(const BlobData& blob, std::uint32_t block) {
    const std::size_t step_bytes = load_u32(blob.bytes + format::header::id_step_bytes_at);
    return id_steps(blob, 0) + (step_bytes + 3) / 4 * 4 + format::ids::block_bytes(has_runs(blob)) * std::size_t{block};
}

/// Where the bits of a run after the block's first begin, counted in bytes from the block's.
inline std::uint32_t run_begin(const std::byte* block, std::uint32_t run) {
    using namespace format::ids;
    return load_u32(block + runs_at) >> (run_begin_bits * (run - 1)) & ((1u << run_begin_bits) - 1u);
}

/// Reads the fields of a block's steps one after the other.
struct StepFields {
    static constexpr unsigned bits_ahead = 57;
    const std::byte* bytes;
    const std::byte* last_word;  ///< the last eight bytes of the section
    unsigned bit = 0;            ///< of the next field

    /// Returns the bits from the next field on, at least `bits_ahead` of them unless the section ends before.
    [[nodiscard]] std::uint64_t ahead() const {
        const std::byte* const at = bytes + bit / 8;
        if (at <= last_word) return load_u64(at) >> (bit % 8);
        return load_u64(last_word) >> (8 * static_cast<unsigned>(at - last_word) + bit % 8);
    }

    /// Returns the next `width` bits, at most 32. Reads no byte outside of the section.
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
        : blob(of), fields{id_steps(of, first_byte), id_block(of, format::ids::block_count(of.triangle_count)) - 8} {}

    /// Begins with the block's first number.
    void begin() {
        first_ = newest = fields.take(static_cast<unsigned>(std::bit_width(mask)));
        begin_run();
    }

    /// Makes the block's first number all recent ones.
    void begin_run() {
        for (std::uint32_t& number : numbers_) number = first_;
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

    /// Finds and takes steps, which there must be. The bits of a step are loaded before it is known where it begins,
    /// which then takes a shift: steps wait for one another's length alone, and the recent numbers follow behind.
    void take_steps(std::uint32_t count) {
        const auto most_bits = blob.id_kind_bits + static_cast<unsigned>(std::bit_width(mask));
        const std::uint32_t kind_mask = (1u << blob.id_kind_bits) - 1u;
        std::uint64_t bits = fields.ahead();
        for (; count != 0; --count) {
            const std::uint64_t loaded = fields.ahead();
            kind = id_kind(blob, static_cast<std::uint32_t>(bits) & kind_mask);
            const unsigned prefix = load_u8(kind + format::ids::prefix_at),
                           width = load_u8(kind + format::ids::width_at), length = prefix + width;
            const auto field = static_cast<std::uint32_t>(bits >> prefix & ((std::uint64_t{1} << width) - 1u));
            fields.bit += length;
            // mutant(<= -> <) equivalent: both have all bits of the next step then
            bits = length + most_bits <= StepFields::bits_ahead ? loaded >> length : fields.ahead();
            add(load_u8(kind + format::ids::from_at), load_u32(kind) + field, load_u8(kind + format::ids::replaced_at));
        }
    }

private:
    /// Adds to the recent number at place `from`. That at place `replaced` gives way, and those before it move back: as
    /// places of `numbers_`, four bits each.
    void add(unsigned from, std::uint32_t distance, unsigned replaced) {
        const std::uint32_t own = places_ >> 4 * replaced & 7u;
        const std::uint32_t moved = (16u << 4 * replaced) - 1u;  // its place and those before it
        newest = (numbers_[places_ >> 4 * from & 7u] + distance) & mask;
        places_ ^= (places_ ^ (places_ << 4 | own)) & moved;
        numbers_[own] = newest;
    }

    std::uint32_t first_ = 0;
    std::uint32_t numbers_[format::ids::recent_numbers];
    std::uint32_t places_ = 0x76543210;  ///< of the recent numbers, that of the newest in the lowest bits
};

/// The number of a triangle that there is. At most 32 steps in a blob with runs.
inline std::uint32_t number_of(const BlobData& blob, std::uint32_t triangle) {
    using namespace format::ids;
    const std::byte* block = id_block(blob, triangle / block_triangles);
    IdWalk walk(blob, load_u32(block));
    walk.begin();
    const std::uint32_t of_run = run_triangles(has_runs(blob));
    const std::uint32_t run = triangle % block_triangles / of_run;
    if (run != 0) walk.fields.bit = 8 * run_begin(block, run);
    std::uint32_t steps = triangle % of_run + (run != 0 ? 1u : 0u);
    if (takes_shortcut()) {
        walk.take_steps(steps);
    } else {
        for (; steps != 0; --steps) {
            walk.find_kind();
            walk.take_step();
        }
    }
    return walk.newest;
}

}  // namespace espalier::detail
