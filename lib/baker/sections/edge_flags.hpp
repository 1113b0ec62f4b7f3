// How the surface bends at each edge of each triangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The squared sine of the angle in 2^-24, rounded down. 0 <= degrees < 90. The same on every machine.
[[nodiscard]] std::uint32_t flat_limit_of(double degrees);

/// For each triangle and each edge, from corner e to the next, a number of format::edge_flags: 0 flat, 1 convex,
/// 2 concave, 3 open. Open is an edge that is not shared by exactly two triangles that run along it in opposite
/// directions. Of the others, flat is one at which the normals differ by no more than the limit; convex one whose other
/// triangle lies below the plane of this one, or folds back onto it; concave the rest. Decided in integers.
[[nodiscard]] std::vector<std::array<std::uint8_t, 3>> edge_flags_of(const LatticeMesh& mesh, std::uint32_t flat_limit);

}  // namespace espalier::baker
