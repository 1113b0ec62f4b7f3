// A leaf's triangles as strips: paths from neighbour to neighbour, joined to one sequence of vertices. How a sequence
// is read is in format.hpp, at `strip_leaf`.
#pragma once

#include <array>
#include <cstdint>

#include <espalier/format.hpp>

#include "binary_tree.hpp"
#include "lattice_mesh.hpp"
#include "neighbours.hpp"

namespace espalier::baker {

struct Strip {
    struct Triangle {
        std::uint32_t place;        ///< in BinaryTree::triangles
        std::uint8_t first_corner;  ///< which of its corners the sequence gives as its first
    };
    std::array<std::uint32_t, format::max_leaf_vertices> entries;  ///< vertices of the mesh
    std::array<Triangle, format::max_leaf_triangles> triangles;    ///< in the order of their windows
    unsigned entry_count = 0;
    unsigned triangle_count = 0;
    std::uint64_t pivots = 0;   ///< a bit for each entry
    std::uint64_t windows = 0;  ///< a bit for each window that is a triangle
};

class StripMaker {
public:
    StripMaker(const LatticeMesh& mesh, const BinaryTree& tree) : mesh_(mesh), tree_(tree), neighbours_(mesh, tree) {}

    /// Returns the entries of the strip that `make` returns: one for each triangle and two for each path. Requires at
    /// most format::max_leaf_triangles triangles.
    [[nodiscard]] unsigned entries_of(const BinaryNode& node) const;

    /// Returns the strip of a node's triangles with the fewest entries of several attempts, of equal ones the one whose
    /// triangles follow each other most closely in the source. Requires that they fit.
    [[nodiscard]] Strip make(const BinaryNode& node) const;

private:
    const LatticeMesh& mesh_;
    const BinaryTree& tree_;
    Neighbours neighbours_;
};

}  // namespace espalier::baker
