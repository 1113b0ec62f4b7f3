// The triangles of a leaf that a moving shape may touch: those whose box meets the one around the shape in time, by the
// slab test of a node's children.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/traversal/alone.hpp>
#endif

/// Of one triangle alone.
inline bool may_touch(const LatticeTriangle& triangle, const RayLanes& sweep, float limit) {
    float enter = sweep.tau_min, leave = limit;
    for (int k = 0; k < 3; ++k) {
        const auto time = [&](int corner) { return static_cast<float>(triangle.corner[corner][k]) * sweep.inverse[k]; };
        const float a = time(0), b = time(1), c = time(2);
        enter = maximum(minimum(a, minimum(b, c)) + sweep.near_offset[k], enter);
        leave = minimum(maximum(a, maximum(b, c)) + sweep.far_offset[k], leave);
    }
    return enter <= leave;
}

template <unsigned groups, class Leaf>
inline typename Leaf::Slots sweep_candidates_of(const Leaf& leaf, const RayLanes& sweep, float limit) {
    Table<groups> times[3];  // when a plane through the vertex is met, but for the offsets
    for (unsigned k = 0; k < 3; ++k) {
        const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
        const Floats inverse = splat(sweep.inverse[k]);
        for (unsigned group = 0; group < Table<groups>::groups_of(leaf.vertex_count); ++group) {
            const Floats coordinate = to_floats(add(offsets_of(leaf, k, group), anchor));
            times[k].set(group, multiply(coordinate, inverse));
        }
    }
    typename Leaf::Slots mask = 0;
    auto corners = corners_of(leaf);
    for (unsigned first = 0; first < leaf.slot_count; first += lanes) {
        const auto [a, b, c] = corners.next();
        Floats enter = splat(sweep.tau_min), leave = splat(limit);
        for (int k = 0; k < 3; ++k) {
            const Floats at_a = times[k].look_up(a), at_b = times[k].look_up(b), at_c = times[k].look_up(c);
            enter = larger(add(smaller(at_a, smaller(at_b, at_c)), splat(sweep.near_offset[k])), enter);
            leave = smaller(add(larger(at_a, larger(at_b, at_c)), splat(sweep.far_offset[k])), leave);
        }
        mask |= typename Leaf::Slots{at_most(enter, leave)} << first;
    }
    return mask & leaf.used_slots();
}

/// Out of line: its tables must not lie on the stack below the kernels.
template <class Leaf>
[[gnu::noinline]] typename Leaf::Slots sweep_candidates(const Leaf& leaf, const RayLanes& sweep, float limit) {
    return with_table_groups<Leaf::max_vertices>(
        leaf.vertex_count, [&](auto groups) { return sweep_candidates_of<groups>(leaf, sweep, limit); });
}
