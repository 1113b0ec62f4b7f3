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

Integer3 between(const LatticePoint& from, const LatticePoint& to) {
    return {std::int64_t{to.x} - from.x, std::int64_t{to.y} - from.y, std::int64_t{to.z} - from.z};
}

/// Edge `number` of a triangle as a vector, the vector from its start to the opposite corner, and the normal.
struct Side {
    Integer3 along;
    Integer3 to_apex;
    Integer3 normal;
};

Side side_of(const LatticeMesh& mesh, const TriangleEdge& edge) {
    const auto corner = [&](unsigned k) -> const LatticePoint& {
        return mesh.vertices[mesh.triangles[edge.triangle].corners[(edge.number + k) % 3u]];
    };
    const Integer3 along = between(corner(0), corner(1));
    const Integer3 to_apex = between(corner(0), corner(2));
    return {along, to_apex, detail::cross(along, to_apex)};
}

/// Of numbers that are not negative and whose product is below 2^127.
Int128 small_product(Int128 a, Int128 b) {
    const Unsigned256 product = Unsigned256::product(a, b);
    return {static_cast<std::int64_t>(product.word[1]), product.word[0]};
}

/// Coordinates differ by less than 2^24, so that normals have lengths below 2^49 and the volume is below 2^74. The
/// normals' cross product is the edge times the volume: |normals' cross|^2 = edge^2 volume^2, below 2^198.
EdgeKind kind_of(const Side& here, const Side& there, std::uint32_t flat_limit) {
    // From a common start: the other triangle runs along the edge in the opposite direction.
    const Integer3 apex = {here.along.x + there.to_apex.x, here.along.y + there.to_apex.y,
                           here.along.z + there.to_apex.z};
    const Int128 height = detail::dot<Int128>(here.normal, apex);
    const Int128 alike = detail::dot<Int128>(here.normal, there.normal);
    if (!alike.is_negative() && !alike.is_zero()) {
        const Int128 volume = height.is_negative() ? -height : height;
        const Int128 edge = detail::dot<Int128>(here.along, here.along);
        const Unsigned256 sine = Unsigned256::product(small_product(edge, volume), volume << 24);
        const Unsigned256 limit = Unsigned256::product(
            detail::dot<Int128>(here.normal, here.normal),
            small_product(Int128(std::int64_t{flat_limit}), detail::dot<Int128>(there.normal, there.normal)));
        if (detail::compare_scaled(sine, limit, 0) <= 0) return EdgeKind::flat;
    }
    return height.is_negative() || height.is_zero() ? EdgeKind::convex : EdgeKind::concave;
}

}  // namespace

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

std::vector<std::array<std::uint8_t, 3>> edge_flags_of(const LatticeMesh& mesh, std::uint32_t flat_limit) {
    constexpr auto open_edge = static_cast<std::uint8_t>(EdgeKind::boundary);
    std::vector<std::array<std::uint8_t, 3>> flags(mesh.triangles.size(), {open_edge, open_edge, open_edge});
    const auto corners_of = [&](std::uint32_t triangle) -> const std::array<std::uint32_t, 3>& {
        return mesh.triangles[triangle].corners;
    };
    const EdgeTable table(static_cast<std::uint32_t>(mesh.triangles.size()), mesh.vertices.size(), corners_of);
    table.for_each_pair([&](std::uint32_t, std::span<const TriangleEdge> edges) {
        const TriangleEdge& here = edges.front();
        const TriangleEdge& there = edges.back();
        if (edges.size() != 2 || here.ascends == there.ascends) return;
        const auto kind = static_cast<std::uint8_t>(kind_of(side_of(mesh, here), side_of(mesh, there), flat_limit));
        flags[here.triangle][here.number] = kind;
        flags[there.triangle][there.number] = kind;
    });
    return flags;
}

}  // namespace espalier::baker
