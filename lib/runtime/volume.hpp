// A shape rounded into lattice units, as the walk through the tree sees it: what encloses it, and a kernel. One walk
// serves all shapes.
#pragma once

#include <cstdint>

#include <espalier/function_ref.hpp>
#include <espalier/types.hpp>
#include <runtime/box_nodes.hpp>
#include <runtime/plane_nodes.hpp>
#include <runtime/ray_triangle.hpp>

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
    /// The bounds, or the planes of a shape without bounds, are the shape itself as far as vertices are concerned: one
    /// that they do not exclude is inside.
    bool encloses_exactly = false;
    IntegerBounds bounds;
};

/// The triangles from storage index `first` on that the shape overlaps, in storage order. False when the visitor
/// stopped it.
bool visit_triangles_in(const BlobData& blob, const Volume& volume, std::uint32_t first,
                        FunctionRef<Visit(Triangle)> visit);

}  // namespace espalier::detail
