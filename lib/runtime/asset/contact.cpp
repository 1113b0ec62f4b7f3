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

InternalFeatures detail::internal_features(const Blob& blob, TriangleId triangle) noexcept {
    const Result<EdgeKinds> kinds = edge_kinds(blob, triangle);
    if (!kinds) return {};
    const auto seen_from = [&kinds](EdgeKind ridge) {
        const auto inner = [ridge](EdgeKind kind) { return kind == ridge || kind == EdgeKind::boundary ? 0u : 1u; };
        const unsigned ab = inner(kinds->ab), bc = inner(kinds->bc), ca = inner(kinds->ca);
        static_assert(Feature::edge_ab == Feature{1} && Feature::vertex_a == Feature{4} &&
                      Feature::vertex_c == Feature{6});
        return static_cast<std::uint8_t>(ab << 1 | bc << 2 | ca << 3 | (ca & ab) << 4 | (ab & bc) << 5 |
                                         (bc & ca) << 6);
    };
    return {seen_from(EdgeKind::convex), seen_from(EdgeKind::concave)};
}

Vec3 fix_internal_edge_normal(const Blob& blob, TriangleId touched, Feature feature, Vec3 normal) noexcept {
    if (feature == Feature::face || !edge_kinds(blob, touched)) return normal;
    const Integer3 face = normal_of(integer_triangle(find_triangle(data_of(blob), touched.index)));
    if (is_zero(face)) return normal;  // a triangle without area, which no baker wrote
    const bool behind = dot(normal, to_vector(face)) < 0.0f;
    return internal_features(blob, touched).have(feature, behind) ? to_unit(behind ? -face : face) : normal;
}

}  // namespace espalier
