// Which triangles lie across the edges of which.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <baker/build/binary_tree.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// For each place in BinaryTree::triangles and each edge (from corner e to the next): the place of a triangle that has
/// the same edge in the other direction, so that both face the same way. Edges are paired one to one; where more than
/// two triangles meet in an edge, in the order of the tree.
class Neighbours {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    Neighbours(const LatticeMesh& mesh, const BinaryTree& tree);

    [[nodiscard]] const std::array<std::uint32_t, 3>& of(std::uint32_t place) const { return across_[place]; }

private:
    std::vector<std::array<std::uint32_t, 3>> across_;
};

}  // namespace espalier::baker
