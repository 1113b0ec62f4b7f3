// A node of the tree over moving instances: exact boxes of eight children, side by side.
#pragma once

#include <cstddef>
#include <cstdint>

#include <runtime/moving_scenes/box_tree/steps_box.hpp>

namespace espalier::detail {

inline constexpr std::uint32_t no_child = 0xFFFFFFFFu;

/// The boxes of up to eight children, in no order. A child is a node, or the slot of an instance at level 0. A place
/// without a child has an empty box, which touches nothing.
struct alignas(32) BoxNode {
    static constexpr unsigned most = 8;   ///< children
    static constexpr unsigned least = 4;  ///< of a node that is not the root

    std::int32_t low[3][most];
    std::int32_t high[3][most];
    std::uint32_t child[most];

    void clear() {
        for (unsigned i = 0; i < most; ++i) drop(i);
    }
    void drop(unsigned i) {
        set_box(i, StepsBox::none());
        child[i] = no_child;
    }
    void set(unsigned i, const StepsBox& box, std::uint32_t number) {
        set_box(i, box);
        child[i] = number;
    }
    void set_box(unsigned i, const StepsBox& box) {
        for (int k = 0; k < 3; ++k) {
            low[k][i] = box.low[k];
            high[k][i] = box.high[k];
        }
    }
    [[nodiscard]] StepsBox box(unsigned i) const {
        return {{low[0][i], low[1][i], low[2][i]}, {high[0][i], high[1][i], high[2][i]}};
    }
    /// Returns the box around all children.
    [[nodiscard]] StepsBox bounds() const {
        StepsBox all = StepsBox::none();
        for (int k = 0; k < 3; ++k)
            for (unsigned i = 0; i < most; ++i) {
                all.low[k] = low[k][i] < all.low[k] ? low[k][i] : all.low[k];
                all.high[k] = high[k][i] > all.high[k] ? high[k][i] : all.high[k];
            }
        return all;
    }
    [[nodiscard]] unsigned count() const {
        unsigned children = 0;
        for (const std::uint32_t number : child) children += number != no_child ? 1u : 0u;
        return children;
    }
    /// Returns the first place without a child, or `most`.
    [[nodiscard]] unsigned free_place() const {
        for (unsigned i = 0; i < most; ++i)
            if (child[i] == no_child) return i;
        return most;
    }
};
static_assert(sizeof(BoxNode) == 224);

}  // namespace espalier::detail
