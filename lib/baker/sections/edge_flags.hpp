// How the surface bends at each edge of each triangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <espalier/contact.hpp>
#include <runtime/lattice/triangle.hpp>

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The squared sine of the angle in 2^-24, rounded down. 0 <= degrees < 90. The same on every machine.
[[nodiscard]] std::uint32_t flat_limit_of(double degrees);

/// A triangle at an edge, which leads from its first corner to its second, in whole steps from any common point.
using TriangleAtEdge = std::array<detail::Integer3, 3>;

/// Returns how the surface bends at an edge that two triangles run along in opposite directions. Coordinates of each
/// differ by less than 2^24. Decided in integers.
[[nodiscard]] EdgeKind kind_of_edge(const TriangleAtEdge& here, const TriangleAtEdge& there, std::uint32_t flat_limit);

/// The flags of a triangle's edges.
struct EdgeFlags {
    std::array<std::uint8_t, 3> kinds;
    std::array<bool, 3> is_alone{};  ///< no other triangle of the mesh has the edge
};

/// For each triangle and each edge, from corner e to the next, a number of format::edge_flags: 0 flat, 1 convex,
/// 2 concave, 3 open. Open is an edge that is not shared by exactly two triangles that run along it in opposite
/// directions. Of the others, flat is one at which the normals differ by no more than the limit; convex one whose other
/// triangle lies below the plane of this one, or folds back onto it; concave the rest. Decided in integers.
[[nodiscard]] std::vector<EdgeFlags> edge_flags_of(const LatticeMesh& mesh, std::uint32_t flat_limit);

}  // namespace espalier::baker
