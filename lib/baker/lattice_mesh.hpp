// The mesh on its lattice: the contract between snapping and every later stage.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lattice.hpp"
#include "source.hpp"

namespace espalier::baker {

/// Corners are numbers into LatticeMesh::vertices, in the winding and with the first corner of the source.
struct LatticeTriangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t original_id;
};

struct LatticeMesh {
    Lattice lattice;
    std::vector<LatticePoint> vertices;         ///< distinct; a few may belong to collapsed triangles alone
    std::vector<std::uint8_t> is_used;          ///< for each vertex: whether a kept triangle has it
    std::vector<LatticeTriangle> triangles;     ///< kept ones; ascending original ids
    std::vector<LatticeTriangle> collapsed;     ///< with an area in the source and none on the lattice
    LatticePoint extent;                        ///< largest coordinates of the kept ones; the smallest are 0
    std::uint32_t used_vertices = 0;
};

}  // namespace espalier::baker
