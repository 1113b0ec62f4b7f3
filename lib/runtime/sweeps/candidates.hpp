// The triangles of a leaf that a moving shape may touch: those whose box meets the one around the shape in time, by the
// slab test of a node's children.
#pragma once

#include <runtime/lanes/prepared_ray.hpp>
#include <runtime/lanes/scalar.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Whether the box around three points is met in time; `time_of(axis, number)` returns when the plane through a point
/// is, but for the offset.
template <class TimeOf>
inline bool may_touch(const RayLanes& sweep, float limit, TimeOf time_of) {
    float enter = sweep.tau_min, leave = limit;
    for (int k = 0; k < 3; ++k) {
        const float a = time_of(k, 0), b = time_of(k, 1), c = time_of(k, 2);
        enter = maximum(minimum(a, minimum(b, c)) + sweep.near_offset[k], enter);
        leave = minimum(maximum(a, maximum(b, c)) + sweep.far_offset[k], leave);
    }
    return enter <= leave;
}

/// Of one triangle alone.
inline bool may_touch(const LatticeTriangle& triangle, const RayLanes& sweep, float limit) {
    return may_touch(sweep, limit, [&](int axis, int number) {
        return static_cast<float>(triangle.corner[number][axis]) * sweep.inverse[axis];
    });
}

/// Out of line: its tables must not lie on the stack below the kernels.
template <class Leaf>
[[gnu::noinline]] typename Leaf::Slots sweep_candidates(const Leaf& leaf, const RayLanes& sweep, float limit) {
    float times[3][Leaf::max_vertices];
    for (unsigned k = 0; k < 3; ++k) {
        const auto anchor = static_cast<std::uint32_t>(leaf.anchor(static_cast<int>(k)));
        for (unsigned vertex = 0; vertex < leaf.vertex_count; ++vertex)
            times[k][vertex] =
                scalar::to_floats(scalar::add(scalar::offsets_of(leaf, k, vertex), anchor)) * sweep.inverse[k];
    }
    typename Leaf::Slots mask = 0;
    auto corners = scalar::corners_of(leaf);
    for (unsigned slot = 0; slot < leaf.slot_count; ++slot) {
        const scalar::CornerNumbers vertices = corners.next();
        const unsigned of_corner[3] = {vertices.a, vertices.b, vertices.c};
        const auto time_of = [&](int axis, int number) { return times[axis][of_corner[number]]; };
        mask |= typename Leaf::Slots{may_touch(sweep, limit, time_of)} << slot;
    }
    return mask & leaf.used_slots();
}

}  // namespace espalier::detail
