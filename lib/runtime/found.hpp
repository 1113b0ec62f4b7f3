// What the inner queries find, still in lattice units.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>
#include <espalier/statistics.hpp>
#include <runtime/best_k.hpp>
#include <runtime/lattice_point.hpp>
#include <runtime/lattice_ray.hpp>
#include <runtime/point_triangle.hpp>
#include <runtime/lattice_triangle.hpp>

namespace espalier::detail {

struct FoundHit {
    TriangleHit hit;
    std::uint32_t index;
};

struct FoundNearest {
    PointDistance distance;
    std::uint32_t index;
    LatticeTriangle triangle;
};

/// Counts nothing, costs nothing.
struct NoCounters {
    void count_node() const {}
    void count_leaf() const {}
    void count_triangles(unsigned) const {}
    void count_candidates(unsigned) const {}
};
inline constexpr NoCounters no_counters;

}  // namespace espalier::detail
