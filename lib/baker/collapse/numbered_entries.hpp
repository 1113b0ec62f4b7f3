// The vertices of a strip by number, as its leaf stores them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include <espalier/format.hpp>

#include <baker/collapse/strip.hpp>

namespace espalier::baker {

/// A strip's vertices, numbered by first use.
struct NumberedEntries {
    unsigned vertex_count = 0;
    std::array<std::uint32_t, format::max_leaf_entries> vertices{};
    std::array<std::uint8_t, format::max_leaf_entries> numbers{};
    std::uint64_t first_uses = 0;

    explicit NumberedEntries(const Strip& strip) {
        for (unsigned entry = 0; entry < strip.entry_count; ++entry) {
            const auto end = vertices.begin() + vertex_count;
            const auto found = std::find(vertices.begin(), end, strip.entries[entry]);
            // mutant(- -> +) equivalent: iterators cannot be added, so the mutant is the original
            numbers[entry] = static_cast<std::uint8_t>(found - vertices.begin());
            if (found != end) continue;
            vertices[vertex_count++] = strip.entries[entry];
            first_uses |= std::uint64_t{1} << entry;
        }
    }
    [[nodiscard]] bool is_first_use(unsigned entry) const { return (first_uses >> entry & 1) != 0; }
};

}  // namespace espalier::baker
