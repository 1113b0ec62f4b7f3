// The triangles of a leaf without lanes: one after the other; or by lower bounds of their keys, the lowest first, for
// walks to what is nearest.
#pragma once

#include <bit>
#include <cstdint>

#include <espalier/base/function_ref.hpp>
#include <espalier/status.hpp>
#include <runtime/base/options.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Calls visit(slot, triangle) for the triangles of a leaf in turn, until one of them answers stop.
template <class Leaf, class OnTriangle>
ESPALIER_SHARED_CODE inline Visit visit_triangles_of(const Leaf& leaf, OnTriangle visit) {
    for (auto slots = leaf.used_slots(); slots != 0; slots &= slots - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(slots));
        if (visit(slot, leaf.triangle(slot)) == Visit::stop) return Visit::stop;
    }
    return Visit::next;
}
template <class Leaf, class Function>
inline Visit for_each_triangle_of(const Leaf& leaf, Function visit) {
    using OnTriangle = Callable<Function, Visit(unsigned, const LatticeTriangle&)>;
    return visit_triangles_of<Leaf, OnTriangle>(leaf, visit);
}

/// So many triangles are put in order together: more would take more stack.
inline constexpr unsigned bounded_together = 16;

/// A lower bound and a slot in one word: bounds are not negative, so that their bits order like integers, and the
/// lowest bits make room for the slot.
struct BoundedSlot {
    std::uint32_t word;

    BoundedSlot() = default;
    BoundedSlot(float bound, unsigned slot)
        : word((std::bit_cast<std::uint32_t>(bound) & ~(bounded_together - 1)) | slot) {}
    [[nodiscard]] float bound() const { return std::bit_cast<float>(word & ~(bounded_together - 1)); }
    [[nodiscard]] unsigned slot() const { return word & (bounded_together - 1); }
};

/// Decides on some triangles of a leaf, `slots` from `first` on.
template <class Leaf, class Bound, class Tighten, class Decide>
ESPALIER_SHARED_CODE inline Visit decide_lowest_bound_first(const Leaf& leaf, unsigned first, unsigned slots,
                                                            const float& limit, Bound bound, Tighten tighten,
                                                            Decide decide) {
    BoundedSlot waiting[bounded_together];
    unsigned count = 0, loose = slots;
    for (; slots != 0; slots &= slots - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(slots));
        const float lower = bound(leaf.triangle(first + slot));
        if (lower <= limit) waiting[count++] = BoundedSlot(lower, slot);
    }
    while (count != 0) {
        BoundedSlot* lowest = waiting;
        for (BoundedSlot* other = waiting + 1; other != waiting + count; ++other)
            if (other->word < lowest->word) lowest = other;
        const unsigned slot = lowest->slot();
        const float lower = lowest->bound();
        if (lower > limit) break;
        const LatticeTriangle triangle = leaf.triangle(first + slot);
        const float tighter = (loose >> slot & 1u) != 0 ? tighten(triangle, lower) : lower;
        loose &= ~(1u << slot);
        if (tighter > limit) {
            *lowest = waiting[--count];
        } else if (tighter > lower) {
            *lowest = BoundedSlot(tighter, slot);
        } else {
            *lowest = waiting[--count];
            if (decide(first + slot, triangle, lower) == Visit::stop) return Visit::stop;
        }
    }
    return Visit::next;
}

/// Calls `decide(slot, triangle, bound)` for the triangles of a leaf whose bounds are within the limit, which the calls
/// may lower. `bound(triangle)` is quick; `tighten(triangle, bound)` returns a bound that is no lower, before a
/// triangle is decided. No bound is a NaN.
template <class Leaf, class Bound, class Tighten, class Decide>
inline Visit decide_by_bounds(const Leaf& leaf, const float& limit, Bound bound, Tighten tighten, Decide decide) {
    using AnyBound = Callable<Bound, float(const LatticeTriangle&)>;
    using AnyTighten = Callable<Tighten, float(const LatticeTriangle&, float)>;
    using AnyDecide = Callable<Decide, Visit(unsigned, const LatticeTriangle&, float)>;
    for (unsigned first = 0; first < leaf.slot_count; first += bounded_together) {
        const auto slots = static_cast<unsigned>(leaf.used_slots() >> first) & ((1u << bounded_together) - 1u);
        if (decide_lowest_bound_first<Leaf, AnyBound, AnyTighten, AnyDecide>(leaf, first, slots, limit, bound, tighten,
                                                                             decide) == Visit::stop)
            return Visit::stop;
    }
    return Visit::next;
}

}  // namespace espalier::detail
