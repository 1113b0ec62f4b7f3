// A hash set of numbered things whose numbers are given in the order of insertion, so that the result depends neither
// on the hash nor on the table's size.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace espalier::baker {

/// Mixes all bits of a key into all bits of the result (the finalizer of splitmix64).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t key) {
    key = (key ^ (key >> 30)) * 0xBF58476D1CE4E5B9u;
    key = (key ^ (key >> 27)) * 0x94D049BB133111EBu;
    return key ^ (key >> 31);
}

class IndexedHashSet {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    explicit IndexedHashSet(std::size_t most_entries)
        : mask_(std::bit_ceil(most_entries * 2 + 1) - 1), slots_(mask_ + 1, none) {}

    /// The number of the entry for which `equals(number)` holds, or `next` after having put it in.
    template <class Equals>
    std::uint32_t find_or_insert(std::uint64_t hash, std::uint32_t next, Equals equals) {
        std::size_t slot = first_slot(hash);
        while (slots_[slot] != none) {
            if (equals(slots_[slot])) return slots_[slot];
            slot = (slot + 1) & mask_;
        }
        slots_[slot] = next;
        return next;
    }

    /// The number of the entry for which `equals(number)` holds, or none.
    template <class Equals>
    [[nodiscard]] std::uint32_t find(std::uint64_t hash, Equals equals) const {
        std::size_t slot = first_slot(hash);
        while (slots_[slot] != none && !equals(slots_[slot])) slot = (slot + 1) & mask_;
        return slots_[slot];
    }

    /// Brings the slot of a later find_or_insert into the cache.
    void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[first_slot(hash)], 1); }

private:
    [[nodiscard]] std::size_t first_slot(std::uint64_t hash) const { return static_cast<std::size_t>(hash & mask_); }

    std::size_t mask_;
    std::vector<std::uint32_t> slots_;
};

}  // namespace espalier::baker
