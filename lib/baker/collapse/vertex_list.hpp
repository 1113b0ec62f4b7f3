// The distinct vertices of a small subtree, merged upwards.
#pragma once

#include <array>
#include <cstdint>

#include <espalier/format.hpp>

namespace espalier::baker {

/// Ascending vertex numbers, as long as there are no more than a leaf may have.
struct VertexList {
    static constexpr unsigned too_many = format::max_leaf_vertices + 1;

    std::array<std::uint32_t, format::max_leaf_vertices> numbers;
    unsigned count = 0;

    [[nodiscard]] bool fits() const { return count != too_many; }
};

/// The corners of one triangle. Those of a deformable blob may repeat a vertex.
[[nodiscard]] inline VertexList list_of(const std::array<std::uint32_t, 3>& corners) {
    const auto [a, b, c] = corners;
    const std::uint32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const std::uint32_t high = a > b ? (a > c ? a : c) : (b > c ? b : c);
    const std::uint32_t middle = a ^ b ^ c ^ low ^ high;
    VertexList list;
    list.numbers[list.count++] = low;
    if (middle != low) list.numbers[list.count++] = middle;
    if (high != middle) list.numbers[list.count++] = high;
    return list;
}

/// The vertices of both.
[[nodiscard]] inline VertexList merge(const VertexList& left, const VertexList& right) {
    VertexList merged;
    if (!left.fits() || !right.fits()) {
        merged.count = VertexList::too_many;
        return merged;
    }
    unsigned from_left = 0;
    unsigned from_right = 0;
    while (from_left < left.count || from_right < right.count) {
        if (merged.count == format::max_leaf_vertices) {
            merged.count = VertexList::too_many;
            return merged;
        }
        // Past its end a list offers a number above all others; equal offers are taken together, without a branch.
        const std::uint64_t a = from_left < left.count ? left.numbers[from_left] : ~std::uint64_t{0};
        const std::uint64_t b = from_right < right.count ? right.numbers[from_right] : ~std::uint64_t{0};
        merged.numbers[merged.count++] = static_cast<std::uint32_t>(a < b ? a : b);
        from_left += a <= b ? 1 : 0;
        from_right += b <= a ? 1 : 0;
    }
    return merged;
}

}  // namespace espalier::baker
