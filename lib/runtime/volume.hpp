// A shape rounded into lattice units, as the walk through the tree sees it: what encloses it, and a kernel. One walk
// serves all shapes.
#pragma once

#include <cstdint>

#include <espalier/function_ref.hpp>
#include <espalier/statistics.hpp>
#include <espalier/types.hpp>
#include <runtime/box_nodes.hpp>
#include <runtime/plane_nodes.hpp>
#include <runtime/lattice_triangle.hpp>

namespace espalier::detail {

/// The base of each rounded shape. It refers to its own members: rounded where it stays.
struct Volume {
    static constexpr unsigned max_planes = 32;

    Volume() = default;
    Volume(const Volume&) = delete;
    Volume& operator=(const Volume&) = delete;

    bool (*meets)(const Volume& volume, const LatticeTriangle& triangle) = nullptr;
    const LatticePlane* planes = nullptr;  ///< the shape lies behind each of them
    unsigned plane_count = 0;
    bool bounded = true;   ///< the shape lies within the bounds; only then are these set
    bool is_empty = true;  ///< nothing overlaps it
    /// A vertex within the bounds and this deep behind each plane is inside the shape: 0 when bounds and planes are the
    /// shape itself, unknown when what encloses it says nothing about its inside.
    std::int64_t depth_inside = unknown;
    static constexpr std::int64_t unknown = -1;
    IntegerBounds bounds;
};

/// The triangles from storage index `first` on that the shape overlaps, in storage order. False when the visitor
/// stopped it.
bool visit_triangles_in(const BlobData& blob, const Volume& volume, std::uint32_t first,
                        FunctionRef<Visit(Triangle)> visit);

/// Whether the shape overlaps any triangle, or the walk comes to a box of no more than `steps` along every axis that
/// overlaps what encloses the shape.
bool may_meet(const BlobData& blob, const Volume& volume, std::int32_t steps, QueryCounters& counters);

}  // namespace espalier::detail
