// The bytes of nodes and leaves in every profile. The layout is in espalier/format and in docs/format.md, section 5.
#pragma once

#include <cstddef>
#include <vector>

#include <baker/build/binary_tree.hpp>
#include <baker/collapse/order.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct EncodedTree {
    std::vector<std::byte> nodes;
    std::vector<std::byte> leaves;
};

[[nodiscard]] EncodedTree encode_tree(const LatticeMesh& mesh, const BinaryTree& tree, const WideTree& wide,
                                      Profile profile);

}  // namespace espalier::baker
