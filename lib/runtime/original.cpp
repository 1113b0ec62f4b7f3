// From triangles and hits back to the source.
#include <espalier/original.hpp>
#include <runtime/bytes.hpp>
#include <runtime/id_steps.hpp>

namespace espalier {

using namespace detail;

namespace {

/// Requires ids, and a triangle that there is.
OriginalTriangle original_of(const BlobData& data, std::uint32_t triangle) {
    const std::uint32_t number = number_of(data, triangle);
    const std::uint32_t factor = corner_factor(data);
    const std::uint32_t id = number / factor;

    std::uint32_t low = 0;  // the last source that begins at or before the id
    std::uint32_t high = data.source_count;
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (load_u32(data.sources + std::size_t{middle} * format::source::bytes) <= id ? low : high) = middle;
    }
    const std::byte* source = data.sources + std::size_t{low} * format::source::bytes;
    static_assert(format::source::first_at == 0);
    return {load_u32(source + format::source::file_at), load_u32(source + format::source::mesh_at),
            id - load_u32(source), number % factor};
}

/// Whether a blob leads back at all.
QueryStatus status_of_ids(const BlobData& data) {
    if (data.bytes == nullptr) return QueryStatus::not_open;
    return data.ids == nullptr ? QueryStatus::no_data : QueryStatus::ok;
}

/// Whether a triangle is one of `count`.
QueryStatus status_of_triangle(Triangle triangle, std::size_t count) {
    if (triangle.index < count) return QueryStatus::ok;
    return triangle == no_triangle ? QueryStatus::not_found : QueryStatus::invalid_argument;
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

}  // namespace

bool original_triangle(const Blob& blob, Triangle triangle, OriginalTriangle& original) noexcept {
    const BlobData& data = blob.data();
    if (data.ids == nullptr || triangle.index >= data.triangle_count) return false;
    original = original_of(data, triangle.index);
    return true;
}

QueryStatus original_triangle(const Blob& blob, std::span<const Triangle> triangles,
                              std::span<OriginalTriangle> originals) noexcept {
    const BlobData& data = blob.data();
    if (triangles.size() != originals.size()) return QueryStatus::invalid_argument;
    if (const QueryStatus status = status_of_ids(data); status != QueryStatus::ok) return status;
    for (const Triangle triangle : triangles)
        if (triangle.index >= data.triangle_count) return QueryStatus::invalid_argument;
    for (std::size_t i = 0; i < triangles.size(); ++i) originals[i] = original_of(data, triangles[i].index);
    return QueryStatus::ok;
}

OriginalHit original_hit(const Blob& blob, const RayHit& hit) noexcept {
    const BlobData& data = blob.data();
    QueryStatus status = status_of_ids(data);
    if (status == QueryStatus::ok) status = status_of_triangle(hit.triangle, data.triangle_count);
    return status == QueryStatus::ok ? turned(original_of(data, hit.triangle.index), hit) : refusal(status);
}

QueryStatus original_hit(const Blob& blob, std::span<const RayHit> hits, std::span<OriginalHit> originals) noexcept {
    if (hits.size() != originals.size()) return QueryStatus::invalid_argument;
    for (std::size_t i = 0; i < hits.size(); ++i) originals[i] = original_hit(blob, hits[i]);
    return QueryStatus::ok;
}

OriginalHit original_hit(std::span<const OriginalTriangle> remap, const RayHit& hit) noexcept {
    const QueryStatus status = status_of_triangle(hit.triangle, remap.size());
    if (status != QueryStatus::ok) return refusal(status);
    const OriginalTriangle& original = remap[hit.triangle.index];
    return original.first_corner < 3 ? turned(original, hit) : refusal(QueryStatus::invalid_argument);
}

}  // namespace espalier
