// Triangles of a leaf that lanes leave to a kernel, or accept without one.
#ifndef ESPALIER_PROXIMITY_OVERLAP_CANDIDATES_HPP
#define ESPALIER_PROXIMITY_OVERLAP_CANDIDATES_HPP

#include <runtime/lanes/set.hpp>
#include <runtime/traversal/find.hpp>

ESPALIER_BEGIN_SET

/// The triangles of a leaf that a shape may overlap, and those with a corner that is clearly inside of it.
template <class Slots>
struct OverlapCandidates {
    Slots near = 0;
    Slots inside = 0;
};
/// Hands the answer those that overlap; `overlaps(slot)` decides on one.
template <class Leaf, class SomeAnswer, class Overlaps>
ESPALIER_ALWAYS_INLINE inline Visit take_candidates(const Leaf& leaf,
                                                    OverlapCandidates<typename Leaf::Slots> candidates,
                                                    SomeAnswer& answer, Overlaps overlaps) {
    for (; candidates.near != 0; candidates.near &= candidates.near - 1) {
        const auto slot = static_cast<unsigned>(std::countr_zero(candidates.near));
        const std::uint32_t reference = storage_index(leaf, slot);
        if (reference < answer.first) continue;
        if ((candidates.inside >> slot & 1u) == 0 && !overlaps(slot)) continue;
        if (answer.take(found_at(leaf, reference), leaf, slot) == Visit::stop) return Visit::stop;
    }
    return Visit::next;
}

ESPALIER_END_SET

#endif
