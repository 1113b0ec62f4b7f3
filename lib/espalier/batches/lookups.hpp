// Batches of lookups by triangle id: the source triangles, materials and corners of an array of triangles, such as
// those in a batch of hits.
//
// arrays.hpp states what every batch refuses. The number of results sets the number of lookups. Any number of threads
// may query the same blob, and no call allocates.
#pragma once

#include <cstdint>
#include <span>

#include <espalier/batches/arrays.hpp>
#include <espalier/blob.hpp>
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

}  // namespace espalier
