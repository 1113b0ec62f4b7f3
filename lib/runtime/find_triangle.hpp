// From a storage index to the triangle.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/lattice_triangle.hpp>

namespace espalier::detail {

/// Requires index < blob.triangle_count. Reads a few nodes a level and one leaf.
LatticeTriangle find_triangle(const BlobData& blob, std::uint32_t index);

}  // namespace espalier::detail
