// Lookups of triangles whose ids lie in an array.
#include <espalier/batches/lookups.hpp>
#include <runtime/batches/fill.hpp>

namespace espalier {

using namespace detail;

Filled original_triangle(const Blob& blob, const Strided<TriangleId>& triangles,
                         std::span<Result<OriginalTriangle>> originals) noexcept {
    return fill_each(check_arrays(blob, originals.size(), triangles), originals,
                     [&](std::size_t i) { return original_triangle(blob, triangles.at(i)); });
}

Filled material(const Blob& blob, const Strided<TriangleId>& triangles, std::span<std::uint16_t> materials) noexcept {
    return fill_each(check_arrays(blob, materials.size(), triangles), materials,
                     [&](std::size_t i) { return material(blob, triangles.at(i)); });
}

Filled triangle_at(const Blob& blob, const Strided<TriangleId>& triangles,
                   std::span<Result<Triangle>> corners) noexcept {
    return fill_each(check_arrays(blob, corners.size(), triangles), corners,
                     [&](std::size_t i) { return triangle_at(blob, triangles.at(i)); });
}

}  // namespace espalier
