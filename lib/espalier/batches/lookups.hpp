// Batches of lookups by triangle id: the source triangles, materials, corners and edges of an array of triangles, such
// as those in a batch of hits.
//
// arrays.hpp states what every batch refuses. The number of results sets the number of lookups. Any number of threads
// may query the same blob, and no call allocates.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/advanced/lattice.hpp>
#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
#include <espalier/contact.hpp>
#include <espalier/original.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>
#include <espalier/types.hpp>
#include <espalier/walk.hpp>

namespace espalier {

/// Writes what original_triangle() returns for each triangle.
Filled original_triangle(const Blob& blob, const Strided<TriangleId>& triangles,
                         std::span<Result<OriginalTriangle>> originals) noexcept;

/// Writes what material() returns for each triangle.
Filled material(const Blob& blob, const Strided<TriangleId>& triangles, std::span<std::uint16_t> materials) noexcept;

/// Writes what triangle_at() returns for each triangle.
Filled triangle_at(const Blob& blob, const Strided<TriangleId>& triangles,
                   std::span<Result<Triangle>> corners) noexcept;

/// What a physics engine needs of a triangle.
struct TriangleData {
    Triangle corners;            ///< those of triangle_at()
    LatticePoint in_steps[3];    ///< the same in lattice steps: equal where two triangles share a vertex
    std::uint16_t material = 0;  ///< that of material()
    EdgeKinds edges;             ///< those of edge_kinds(); boundaries if the blob has no edge flags
    std::uint8_t reserved[3] = {};
};

/// Writes the corners, the material and the edges of each triangle: one descent to each, O(depth). The statuses are
/// those of triangle_at().
Filled triangle_data(const Blob& blob, const Strided<TriangleId>& triangles,
                     std::span<Result<TriangleData>> data) noexcept;

}  // namespace espalier
