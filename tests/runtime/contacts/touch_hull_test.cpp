// Claims about contacts of convex hulls: their faces by exact planes, distance, depth and direction by the reference.
#include "support/testing.hpp"

#include <runtime/contacts/hull_body.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/exact/grid_triangles.hpp"

#include "touched.hpp"

namespace espalier::tests::touch_hull_test {
namespace {

using detail::Int128;
using detail::Integer3;
using detail::contacts::HullBody;
using detail::contacts::Touches;

using Vertices = std::vector<std::array<std::int64_t, 3>>;

HullBody hull_of(const Vertices& vertices) {
    HullBody hull{};
    detail::contacts::set_vertices(hull, vertices.data(), static_cast<unsigned>(vertices.size()), 0);
    detail::contacts::find_faces(hull);
    return hull;
}

/// A hull of any kind around a point: with volume, flat, a segment or a point; with vertices that are no corners.
Vertices some_hull(Random& random, const GridPoint& at, std::int32_t reach, unsigned most) {
    const unsigned kind = random.below(8), count = 1 + random.below(most);
    Vertices vertices;
    std::array<std::int64_t, 3> axes[3];
    for (auto& axis : axes)
        for (auto& along : axis) along = random.between(-reach, reach);
    if (kind == 1)  // along the axes of the lattice
        for (unsigned i = 0; i < 3; ++i)
            for (unsigned k = 0; k < 3; ++k) axes[i][k] = i == k ? axes[i][k] : 0;
    const unsigned dimensions = kind == 2 ? 2 : kind == 3 ? 1 : 3;
    for (unsigned i = 0; i < count; ++i) {
        std::array<std::int64_t, 3> vertex = {at[0], at[1], at[2]};
        if (kind < 5) {  // corners, middles of edges and of faces of a box
            for (unsigned j = 0; j < dimensions; ++j) {
                const std::int64_t along = random.between(-1, 1);
                for (unsigned k = 0; k < 3; ++k) vertex[k] += along * axes[j][k];
            }
        } else {
            const std::int32_t thickness = kind == 5 ? std::min(reach, 2) : reach;
            for (unsigned k = 0; k < 3; ++k)
                vertex[k] += random.between(k == 2 ? -thickness : -reach, k == 2 ? thickness : reach);
        }
        vertices.push_back(vertex);
    }
    return vertices;
}

Points points_of(const Vertices& vertices) {
    Points points;
    for (const auto& v : vertices)
        points.push_back({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])});
    return points;
}

TEST_CASE("contact: the faces of a hull have all vertices behind them and close it") {
    Random random(11);
    std::uint64_t solid = 0, flat = 0, thin = 0;
    const std::uint64_t count = scaled(5'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::int32_t reach = 1 << random.below(29);
        const Vertices vertices = some_hull(random, {0, 0, 0}, i % 2 == 0 ? 3 : reach / 2 + 1, max_hull_vertices);
        const HullBody hull = hull_of(vertices);
        const auto seen = [&](const auto& v) { return Integer3{v[0], v[1], v[2]} - hull.middle; };
        std::set<std::pair<unsigned, unsigned>> half_edges;
        for (unsigned face = 0; face < hull.face_count; ++face) {
            const unsigned first = hull.first[face], end = hull.first[face + 1];
            const Integer3 normal = hull.normal_of_face(face), start = hull.units_at(hull.from[first]);
            if (end - first > 2) REQUIRE(!is_zero(normal));
            for (const auto& v : vertices) REQUIRE(!(Int128(0) < detail::dot<Int128>(normal, seen(v) - start)));
            for (unsigned h = first; h < end; ++h) {
                const unsigned a = hull.from[h], b = hull.from[hull.next(face, h)];
                REQUIRE(detail::dot<Int128>(normal, hull.units_at(a) - start).is_zero());
                REQUIRE(half_edges.emplace(a, b).second);
                // The corner behind belongs to the other face.
                const Integer3 edge = hull.units_at(b) - hull.units_at(a);
                const Integer3 other = cross(hull.units_at(hull.across[h]) - hull.units_at(a), edge);
                for (const auto& v : vertices)
                    REQUIRE(!(Int128(0) < detail::dot<Int128>(other, seen(v) - hull.units_at(a))));
                // A convex corner.
                if (end - first > 2) {
                    const Integer3 next =
                        hull.units_at(hull.from[hull.next(face, hull.next(face, h))]) - hull.units_at(b);
                    const Integer3 turn = cross(edge, next), size = detail::magnitude(normal);
                    const int k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
                    REQUIRE((turn[k] > 0) == (normal[k] > 0));
                    REQUIRE(turn[k] != 0);
                }
            }
        }
        for (const auto& [a, b] : half_edges) REQUIRE(half_edges.count({b, a}) == 1);
        if (hull.face_count > 2) {
            ++solid;
            REQUIRE(2 * hull.vertex_count + 2 * hull.face_count == half_edges.size() + 4);
        } else if (hull.vertex_count > 2) {
            ++flat;
        } else {
            ++thin;
            // The farthest two, or all vertices are one.
            std::int64_t most = 0;
            for (const auto& v : vertices)
                for (unsigned corner = 0; corner < hull.vertex_count; ++corner)
                    most = std::max(most, detail::sum_of_magnitudes(seen(v) - hull.units_at(corner)));
            const Integer3 length = hull.units_at(hull.vertex_count - 1) - hull.units_at(0);
            REQUIRE(most == detail::sum_of_magnitudes(length));
        }
    }
    CHECK(solid > count / 2);
    CHECK(flat > count / 50);
    CHECK(thin > count / 50);
}

TEST_CASE("contact: a hull has the distance or depth and the direction of the reference") {
    Random random(12);
    Tally tally;
    const std::uint64_t count = scaled(4'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 4 + random.below(16);
        GridTriangle triangle = some_triangle(random, bits);
        if (random.below(16) == 0) triangle.c = random.coin() ? triangle.b : triangle.a;
        if (random.below(64) == 0) triangle.b = triangle.c = triangle.a;
        const GridPoint at = point_near(random, bits, triangle);
        const std::int32_t reach = std::max(1, (1 << bits) / (random.coin() ? 3 : 40));
        Vertices vertices = some_hull(random, at, reach, i % 16 == 0 ? 12 : 7);
        if (random.below(4) == 0) {  // in the triangle's plane and along its sides, or nearly
            const std::int32_t off = random.coin() ? 0 : 1 << random.below(6);
            const GridPoint* const corners[3] = {&triangle.a, &triangle.b, &triangle.c};
            for (auto& vertex : vertices) {
                const std::int32_t u = random.between(-2, 2), v = random.between(-2, 2);
                for (unsigned k = 0; k < 3; ++k)
                    vertex[k] = (*corners[0])[k] + u * ((*corners[1])[k] - (*corners[0])[k]) +
                                v * ((*corners[2])[k] - (*corners[0])[k]) + random.between(-off, off);
            }
        }
        const HullBody hull = hull_of(vertices);
        const double size = std::ldexp(1.0, static_cast<int>(bits)) + static_cast<double>(hull.size);
        const double error = size * 0x1p-18;
        const float margin = static_cast<float>(size) * 0.1f;
        GridPoint middle;
        for (unsigned k = 0; k < 3; ++k) middle[k] = static_cast<std::int32_t>(hull.middle[k]);
        Touches touches;
        detail::contacts::touch_hull(hull, lattice_triangle(triangle), side_of(middle, triangle), margin, touches);
        CAPTURE(i);
        tally.take({{points_of(vertices), corners_of(triangle), to_point(middle), error, false, 2.0}, size}, touches,
                   margin);  // its middle is a whole number
    }
    tally.report(count, "hulls");
}

}  // namespace
}  // namespace espalier::tests::touch_hull_test
