// From triangles and hits back to the source.
#include <espalier/original.hpp>
#include <runtime/asset/lookups.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/blob/id_steps.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Requires ids, and a triangle that there is.
OriginalTriangle original_of(const BlobData& data, std::uint32_t triangle) {
    const std::uint32_t number = number_of(data, triangle);
    const bool has_corners = corner_factor(data) == 3;
    const std::uint32_t id = has_corners ? number / 3 : number;  // by a constant, which needs no division

    std::uint32_t low = 0;  // the last source that begins at or before the id
    std::uint32_t high = data.source_count;
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (load_u32(data.sources + std::size_t{middle} * format::source::bytes) <= id ? low : high) = middle;
    }
    const std::byte* source = data.sources + std::size_t{low} * format::source::bytes;
    static_assert(format::source::first_at == 0);
    return {load_u32(source + format::source::file_at), load_u32(source + format::source::mesh_at),
            id - load_u32(source), number - (has_corners ? 3 * id : id)};
}

OriginalHit refusal(QueryStatus status) { return {0, 0, 0, 0.0f, 0.0f, status}; }

/// The corner that comes first in the source has the weight that is left over, or one of those of the blob's b and c.
OriginalHit turned(const OriginalTriangle& original, const RayHit& hit) {
    const float rest = (1.0f - hit.u) - hit.v;
    // mutant(> -> >=) equivalent: both sides are equal then
    const float a = rest > 0.0f ? rest : 0.0f;
    OriginalHit result = {original.file, original.mesh, original.triangle, hit.u, hit.v, QueryStatus::ok};
    if (original.first_corner == 1) {
        result.u = a;
        result.v = hit.u;
    } else if (original.first_corner == 2) {
        result.u = hit.v;
        result.v = a;
    }
    return result;
}

/// Writes the result for each argument. Refuses only spans of different sizes.
template <class Argument, class Original, class Query>
Filled fill_originals(const Blob& blob, std::span<const Argument> arguments, std::span<Original> originals,
                      Query query) {
    if (arguments.size() != originals.size()) return {0, {}, QueryStatus::invalid_argument};
    for (std::size_t i = 0; i < arguments.size(); ++i) originals[i] = query(arguments[i]);
    return {arguments.size(), {}, status_of_section(data_of(blob), data_of(blob).ids)};
}

}  // namespace

Result<OriginalTriangle> original_triangle(const Blob& blob, TriangleId triangle) noexcept {
    const BlobData& data = data_of(blob);
    const QueryStatus status = status_of_lookup(data, data.ids, triangle);
    if (status != QueryStatus::ok) return {{}, status};
    return {original_of(data, triangle.index), status};
}

Filled original_triangle(const Blob& blob, std::span<const TriangleId> triangles,
                         std::span<Result<OriginalTriangle>> originals) noexcept {
    return fill_originals(blob, triangles, originals,
                          [&](TriangleId triangle) { return original_triangle(blob, triangle); });
}

OriginalHit original_hit(const Blob& blob, const RayHit& hit) noexcept {
    const BlobData& data = data_of(blob);
    const QueryStatus status = status_of_lookup(data, data.ids, hit.triangle);
    return status == QueryStatus::ok ? turned(original_of(data, hit.triangle.index), hit) : refusal(status);
}

Filled original_hit(const Blob& blob, std::span<const RayHit> hits, std::span<OriginalHit> originals) noexcept {
    return fill_originals(blob, hits, originals, [&](const RayHit& hit) { return original_hit(blob, hit); });
}

OriginalHit original_hit(std::span<const OriginalTriangle> remap, const RayHit& hit) noexcept {
    const QueryStatus status = status_of_triangle(hit.triangle, remap.size());
    if (status != QueryStatus::ok) return refusal(status);
    const OriginalTriangle& original = remap[hit.triangle.index];
    return original.first_corner < 3 ? turned(original, hit) : refusal(QueryStatus::invalid_argument);
}

}  // namespace espalier
