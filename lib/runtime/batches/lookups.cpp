// Lookups of triangles whose ids lie in an array.
#include <espalier/batches/lookups.hpp>
#include <runtime/batches/fill.hpp>
#include <runtime/traversal/find_triangle.hpp>

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

Filled triangle_data(const Blob& blob, const Strided<TriangleId>& triangles,
                     std::span<Result<TriangleData>> data) noexcept {
    return fill_each(check_arrays(blob, data.size(), triangles), data, [&](std::size_t i) {
        const TriangleId id = triangles.at(i);
        Result<TriangleData> result;
        result.status = id.index < blob.triangle_count() ? QueryStatus::ok : QueryStatus::invalid_argument;
        if (!result) return result;
        const LatticeTriangle triangle = find_triangle(data_of(blob), id.index);
        result.value.corners = corners_at(data_of(blob), id.index, &triangle);
        for (unsigned k = 0; k < 3; ++k) {
            const std::int32_t* const at = triangle.corner[k];
            result.value.in_steps[k] = {at[0], at[1], at[2]};
        }
        result.value.material = material(blob, id);
        result.value.edges = edge_kinds(blob, id).value;
        return result;
    });
}

}  // namespace espalier
