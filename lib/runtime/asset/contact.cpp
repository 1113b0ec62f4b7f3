// Edge flags, and the normals of contacts on internal edges.
#include <espalier/contact.hpp>
#include <runtime/asset/internal_edges.hpp>
#include <runtime/asset/lookups.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/traversal/find_triangle.hpp>

namespace espalier {

using namespace detail;

Result<EdgeKinds> edge_kinds(const Blob& blob, TriangleId triangle) noexcept {
    using namespace format::edge_flags;
    const BlobData& data = data_of(blob);
    const QueryStatus status = status_of_lookup(data, data.edge_flags, triangle);
    if (status != QueryStatus::ok) return {{}, status};
    const auto kind = [&](unsigned edge) {
        // A field of 2 bits never lies in two bytes.
        const std::uint64_t bit = std::uint64_t{triangle.index} * triangle_bits + std::uint64_t{edge} * edge_bits;
        return static_cast<EdgeKind>(load_u8(data.edge_flags + fields_at + bit / 8) >> (bit % 8) & 3u);
    };
    return {{kind(0), kind(1), kind(2)}, status};
}

bool detail::is_internal(const Blob& blob, TriangleId triangle, Feature feature) noexcept {
    const Result<EdgeKinds> kinds = edge_kinds(blob, triangle);
    if (!kinds) return false;
    // Edges ab, bc, ca are bits 0, 1, 2; on a corner meet the edge that leads from it and the one before.
    constexpr std::uint8_t edges_of[] = {0b000, 0b001, 0b010, 0b100, 0b101, 0b011, 0b110};
    static_assert(Feature::edge_ab == Feature{1} && Feature::vertex_a == Feature{4} && Feature::vertex_c == Feature{6});
    const auto part = static_cast<unsigned>(feature);
    const unsigned edges = part < sizeof edges_of ? edges_of[part] : 0u;
    const auto outer = [](EdgeKind kind) { return kind == EdgeKind::convex || kind == EdgeKind::boundary ? 1u : 0u; };
    const unsigned outer_edges = outer(kinds->ab) | outer(kinds->bc) << 1 | outer(kinds->ca) << 2;
    return edges != 0 && (edges & outer_edges) == 0;
}

Vec3 fix_internal_edge_normal(const Blob& blob, TriangleId touched, Feature feature, Vec3 normal) noexcept {
    if (!is_internal(blob, touched, feature)) return normal;
    const Integer3 face = normal_of(integer_triangle(find_triangle(data_of(blob), touched.index)));
    if (is_zero(face)) return normal;  // a triangle without area, which no baker wrote
    const bool behind = normal.x * to_float(face.x) + normal.y * to_float(face.y) + normal.z * to_float(face.z) < 0.0f;
    return to_unit(behind ? -face : face);
}

}  // namespace espalier
