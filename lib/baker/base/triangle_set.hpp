// Triangles that are already there: the same three vertices in the same winding, whichever comes first.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <baker/base/indexed_hash_set.hpp>

namespace espalier::baker {

class TriangleSet {
public:
    using Corners = std::array<std::uint32_t, 3>;

    explicit TriangleSet(std::size_t most_triangles) : table_(most_triangles) { keys_.reserve(most_triangles); }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(keys_.size()); }

    /// The number of the triangle that was there first; a new one gets the next number.
    std::uint32_t find_or_insert(const Corners& corners) {
        const Corners key = rotated(corners);
        const std::uint32_t number =
            table_.find_or_insert(hash_of(key), size(), [&](std::uint32_t other) { return keys_[other] == key; });
        if (number == size()) keys_.push_back(key);
        return number;
    }

    /// Brings what a later find_or_insert needs into the cache.
    void prefetch(const Corners& corners) const { table_.prefetch(hash_of(rotated(corners))); }

private:
    /// The smallest number first; the winding stays.
    static Corners rotated(const Corners& corners) {
        const auto [a, b, c] = corners;
        if (a < b && a < c) return {a, b, c};
        if (b < c) return {b, c, a};
        return {c, a, b};
    }
    static std::uint64_t hash_of(const Corners& key) {
        return mix_bits((std::uint64_t{key[0]} << 32 | key[1]) ^ mix_bits(key[2]));
    }

    IndexedHashSet table_;
    std::vector<Corners> keys_;
};

}  // namespace espalier::baker
