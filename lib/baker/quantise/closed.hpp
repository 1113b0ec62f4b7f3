// Whether triangles form a closed surface.
#pragma once

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Tests whether the boundary of the baked triangles cancels along lines: wherever one edge runs, as many run along it
/// in one direction as in the other. The edges need not end in the same places: a long edge cancels with two short
/// ones that lie on it. False without triangles. Exact.
[[nodiscard]] bool is_closed(const LatticeMesh& mesh);

/// Tests whether the edges of the baked triangles, from vertex to vertex, cancel in pairs of opposite direction. False
/// without triangles.
[[nodiscard]] bool edges_cancel_in_pairs(const LatticeMesh& mesh);

/// Tests whether the edges of all sound triangles, those without area included, cancel in pairs of opposite direction.
/// Corners at equal positions are one vertex. False without triangles.
[[nodiscard]] bool is_closed(const Source& source);

}  // namespace espalier::baker
