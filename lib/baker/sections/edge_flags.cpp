#include <baker/sections/edge_flags.hpp>

#include <cstddef>
#include <span>

#include <espalier/contact.hpp>
#include <espalier/format.hpp>
#include <runtime/base/wide_integer.hpp>
#include <runtime/lattice/triangle.hpp>

#include <baker/base/edge_table.hpp>

namespace espalier::baker {

namespace {

using detail::Int128;
using detail::Integer3;
using detail::Unsigned256;

TriangleAtEdge triangle_at(const LatticeMesh& mesh, const TriangleEdge& edge) {
    const auto corner = [&](unsigned k) -> Integer3 {
        const LatticePoint& at = mesh.vertices[mesh.triangles[edge.triangle].corners[(edge.number + k) % 3u]];
        return {at.x, at.y, at.z};
    };
    return {corner(0), corner(1), corner(2)};
}

/// Multiplies numbers that are not negative and whose product is below 2^127.
Int128 small_product(Int128 a, Int128 b) {
    const Unsigned256 product = Unsigned256::product(a, b);
    return {static_cast<std::int64_t>(product.word[1]), product.word[0]};
}

}  // namespace

// Normals have lengths below 2^49 and the volume is below 2^74. The normals' cross product is the edge times the
// volume: |normals' cross|^2 = edge^2 volume^2, below 2^198.
EdgeKind kind_of_edge(const TriangleAtEdge& here, const TriangleAtEdge& there, std::uint32_t flat_limit) {
    const Integer3 along = here[1] - here[0];
    const Integer3 normal = detail::cross(along, here[2] - here[0]);
    const Integer3 other_normal = detail::cross(there[1] - there[0], there[2] - there[0]);
    const Int128 height = detail::dot<Int128>(normal, there[2] - here[0]);
    const Int128 alike = detail::dot<Int128>(normal, other_normal);
    if (!alike.is_negative() && !alike.is_zero()) {
        const Int128 volume = height.is_negative() ? -height : height;
        const Int128 edge = detail::dot<Int128>(along, along);
        const Unsigned256 sine = Unsigned256::product(small_product(edge, volume), volume << 24);
        const Unsigned256 limit = Unsigned256::product(
            detail::dot<Int128>(normal, normal),
            small_product(Int128(std::int64_t{flat_limit}), detail::dot<Int128>(other_normal, other_normal)));
        if (detail::compare_scaled(sine, limit, 0) <= 0) return EdgeKind::flat;
    }
    return height.is_negative() || height.is_zero() ? EdgeKind::convex : EdgeKind::concave;
}

std::uint32_t flat_limit_of(double degrees) {
    // The series of the sine in plain arithmetic: no two libraries need agree on its last bit.
    const double angle = degrees * (3.14159265358979323846 / 180.0);
    double term = angle;
    double sine = angle;
    for (int n = 2; n < 30; n += 2) {
        term *= -angle * angle / (n * (n + 1));
        sine += term;
    }
    return static_cast<std::uint32_t>(sine * sine * format::edge_flags::max_flat_limit);
}

std::vector<EdgeFlags> edge_flags_of(const LatticeMesh& mesh, std::uint32_t flat_limit) {
    constexpr auto open_edge = static_cast<std::uint8_t>(EdgeKind::boundary);
    std::vector<EdgeFlags> flags(mesh.triangles.size(), {{open_edge, open_edge, open_edge}});
    const auto corners_of = [&](std::uint32_t triangle) -> const std::array<std::uint32_t, 3>& {
        return mesh.triangles[triangle].corners;
    };
    const EdgeTable table(static_cast<std::uint32_t>(mesh.triangles.size()), mesh.vertices.size(), corners_of);
    table.for_each_pair([&](std::uint32_t, std::span<const TriangleEdge> edges) {
        const TriangleEdge& here = edges.front();
        const TriangleEdge& there = edges.back();
        if (edges.size() == 1) flags[here.triangle].is_alone[here.number] = true;
        if (edges.size() != 2 || here.ascends == there.ascends) return;
        const auto kind =
            static_cast<std::uint8_t>(kind_of_edge(triangle_at(mesh, here), triangle_at(mesh, there), flat_limit));
        flags[here.triangle].kinds[here.number] = kind;
        flags[there.triangle].kinds[there.number] = kind;
    });
    return flags;
}

}  // namespace espalier::baker
