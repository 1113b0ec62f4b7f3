// What the top-down builders of this folder share.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/sah_split.hpp>
#include <baker/quantise/lattice_mesh.hpp>

#include "../base.hpp"

namespace espalier::bench {

/// Returns a reference to each triangle, in the order of the mesh.
inline std::vector<baker::Reference> references_of(const baker::LatticeMesh& mesh) {
    std::vector<baker::Reference> references(mesh.triangles.size());
    for (std::uint32_t i = 0; i < references.size(); ++i) baker::put_reference(mesh, i, references[i]);
    return references;
}

inline void write_node(baker::BinaryNode& node, const baker::LaneBox& box, std::uint32_t first, std::uint32_t count) {
    std::memcpy(&node, &box, sizeof node);
    node.first = first;
    node.count = count;
}

/// Returns the axis along which the box is longest, of equal ones the first.
inline unsigned longest_side(const baker::LaneBox& box) {
    const baker::Lanes side = box.hi - box.lo;
    return side[0] >= side[1] && side[0] >= side[2] ? 0 : side[1] >= side[2] ? 1 : 2;
}

}  // namespace espalier::bench
