// The triangles of a leaf, one after the other.
#pragma once

#include <bit>

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

}  // namespace espalier::detail
