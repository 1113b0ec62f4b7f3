// Which triangle of the source each triangle of the blob is.
#pragma once

#include <vector>

#include <espalier/types.hpp>

#include <baker/collapse/order.hpp>
#include <baker/input/source.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// By storage index, copies included.
[[nodiscard]] std::vector<OriginalTriangle> remap_of(const Source& source, const LatticeMesh& mesh,
                                                     const WideTree& wide);

}  // namespace espalier::baker
