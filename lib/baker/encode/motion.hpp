// What only a deformable blob has: corners, vertex sources, and fields of the header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <baker/collapse/order.hpp>
#include <baker/encode/tree.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// Appends the sections of corners and of vertex sources. Returns the vertices of all leaves together.
[[nodiscard]] std::uint32_t put_corners_and_sources(std::vector<std::byte>& blob, const LatticeMesh& mesh,
                                                    const WideTree& wide);

/// Writes the fields of the header that only a deformable blob has. The mesh has a triangle.
void put_motion(std::byte* header, const LatticeMesh& mesh, std::uint32_t vertex_slots, const EncodedTree& tree);

}  // namespace espalier::baker
