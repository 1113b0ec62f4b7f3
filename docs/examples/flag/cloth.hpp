// The cloth: a grid that hangs at a pole, and waves that run along it. A formula bends it; a game has a solver instead.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/bake.hpp>

namespace flag {

/// Returns the triangles of the grid. Their numbers do not change when the cloth moves.
[[nodiscard]] std::vector<espalier::TriangleVertices> cloth_triangles();

/// Writes the positions of all vertices at a step: in a breeze first, then in a gust, and so on.
void move_cloth(std::uint32_t step, std::vector<espalier::Vec3>& positions);

}  // namespace flag
