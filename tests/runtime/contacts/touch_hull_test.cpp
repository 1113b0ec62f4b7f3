// Claims about contacts of convex hulls: their faces by exact planes, distance, depth and direction by the reference;
// and of hulls and boxes beyond the tip of what is as thin as a needle.
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
using detail::operator*;
using detail::operator+;

using Vertices = std::vector<std::array<std::int64_t, 3>>;

HullBody hull_of(const Vertices& vertices, int fraction_bits = 0) {
    HullBody hull{};
    detail::contacts::set_vertices(hull, vertices.data(), static_cast<unsigned>(vertices.size()), fraction_bits);
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

TEST_CASE("contact: beyond the tip of a needle a box and a hull are as far away as the tip") {
    // On a grid with spare bits, where no difference is exact in float.
    constexpr int spare_bits = 8;
    constexpr Vec3 units[3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    Random random(13);
    std::uint64_t near = 0;
    double worst = 0.0;
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 8 + random.below(13);
        const std::int32_t last = (1 << bits) - 1;
        const GridPoint tip = some_grid_point(random, bits), end = some_grid_point(random, bits);
        GridTriangle needle = {end, end, tip};
        const std::int32_t width = random.below(4) == 0 ? 0 : 2;
        for (std::int32_t& along : needle.b) along = std::clamp(along + random.between(-width, width), 0, last);
        const double beyond = std::exp2(-static_cast<double>(random.below(12)));
        Vertices vertices(1 + 7 * random.below(2));
        Integer3 center;
        double at[3];
        for (unsigned k = 0; k < 3; ++k) {
            const double way = static_cast<double>(tip[k] - end[k]) * beyond;
            center[k] = static_cast<std::int64_t>(std::round((static_cast<double>(tip[k]) + way) * 256.0));
            for (std::size_t corner = 0; corner < vertices.size(); ++corner)
                vertices[corner][k] = center[k] + ((corner >> k & 1u) != 0 ? 2 : 0);
            at[k] = static_cast<double>(center[k]) / 256.0;
        }
        const detail::contacts::BoxBody box = box_of(center, units, spare_bits);
        const double size = std::ldexp(1.0, static_cast<int>(bits) + 1), error = size * 0x1p-18;
        const float margin = static_cast<float>(size);
        const double expected = std::sqrt(reference::squared_distance(
            {at[0], at[1], at[2]}, {to_point(needle.a), to_point(needle.b), to_point(needle.c)}));
        Touches of_box, of_hull;
        detail::contacts::touch_box(box, lattice_triangle(needle), {}, margin, of_box);
        const HullBody hull = hull_of(vertices, spare_bits);
        detail::contacts::touch_hull(hull, lattice_triangle(needle), {}, margin, of_hull);
        CAPTURE(i);
        for (const Touches* touches : {&of_box, &of_hull}) {
            REQUIRE((touches->count != 0) == (expected < size));
            if (touches->count == 0) continue;
            ++near;
            const double off = std::abs(static_cast<double>(touches->nearest) - expected);
            worst = std::max(worst, off / size);
            REQUIRE(off <= error + 0.02);  // the body is that large
        }
    }
    CHECK(near > count);
    MESSAGE(count, " needles; worst error ", worst, " of the size");
}

TEST_CASE("contact: beyond the tip of a sheared box a point is as far away as the tip") {
    Random random(14);
    std::uint64_t near = 0;
    double worst = 0.0;
    const std::uint64_t count = scaled(100'000);
    const auto whole = [](const Vec3& v) { return Vec3{std::round(v.x), std::round(v.y), std::round(v.z)}; };
    for (std::uint64_t i = 0; i < count; ++i) {
        const unsigned bits = 8 + random.below(12);
        const float reach = std::ldexp(1.0f, static_cast<int>(bits) + 8);
        Vec3 half[3] = {whole(random.in_cube(reach)), {}, {}};
        half[1] = whole(half[0] * (static_cast<float>(random.between(-8, 8)) * 0.125f) +
                        random.in_cube(random.coin() ? 1.0f : 8.0f));
        half[2] = whole(random.in_cube(random.coin() ? reach : 64.0f));
        const Vec3 tip = half[0] * (random.coin() ? 1.0f : -1.0f) + half[1] * (random.coin() ? 1.0f : -1.0f);
        const float beyond = (1.0f + std::ldexp(1.0f, -static_cast<int>(random.below(12)))) * 0x1p-8f;
        const GridPoint at = some_grid_point(random, bits);
        const detail::contacts::BoxBody box = box_of(Integer3{at[0], at[1], at[2]} << 8, half, 8);
        const float ways[3] = {tip.x * beyond, tip.y * beyond, tip.z * beyond};
        GridPoint place;
        for (unsigned k = 0; k < 3; ++k) place[k] = at[k] + static_cast<std::int32_t>(std::round(ways[k]));
        const GridTriangle triangle = {place, place, place};
        const double size = std::ldexp(1.0, static_cast<int>(bits)) + static_cast<double>(box.size);
        Vertices vertices(8);
        for (std::size_t corner = 0; corner < 8; ++corner)
            for (unsigned k = 0; k < 3; ++k) {
                vertices[corner][k] = box.center[k];
                for (unsigned axis = 0; axis < 3; ++axis)
                    vertices[corner][k] += (corner >> axis & 1u) != 0 ? box.units[axis][k] : -box.units[axis][k];
            }
        const float margin = static_cast<float>(size);
        const double expected = reference::signed_separation(corners_of(to_point(at), box.half), {to_point(place)});
        Touches of_box, of_hull;
        detail::contacts::touch_box(box, lattice_triangle(triangle), {}, margin, of_box);
        const HullBody hull = hull_of(vertices, 8);
        detail::contacts::touch_hull(hull, lattice_triangle(triangle), {}, margin, of_hull);
        CAPTURE(i);
        if (expected > 0.0) ++near;
        for (const Touches* touches : {&of_box, &of_hull}) {
            REQUIRE(touches->count != 0);
            const double off = std::abs(static_cast<double>(touches->nearest) - expected);
            worst = std::max(worst, off / size);
            REQUIRE(off <= size * 0x1p-18);
        }
    }
    CHECK(near > count / 2);
    MESSAGE(count, " boxes; worst error ", worst, " of the size");
}

TEST_CASE("contact: beside the small end of a long hull a point is as far away as that end") {
    // The corners of the end are alike in float, as it is far from the middle.
    Random random(15);
    double worst = 0.0;
    const std::uint64_t count = scaled(20'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        constexpr std::int32_t middle = 1 << 19;  // in steps
        Vertices vertices(6);
        GridPoint point;
        const std::int32_t beside = 1 << (4 + random.below(12));
        for (unsigned k = 0; k < 3; ++k) {
            const std::int32_t end = random.between(-middle, middle) * 256;
            for (unsigned corner = 0; corner < 6; ++corner)
                vertices[corner][k] = middle * 256 + (corner < 3 ? end : -end) + random.between(-4, 4);
            point[k] = middle + std::clamp(end / 256 + random.between(-beside, beside), -middle, middle - 1);
        }
        const GridTriangle triangle = {point, point, point};
        const double expected = reference::signed_separation(points_of(vertices), {256.0 * to_point(point)}) / 256.0;
        const HullBody hull = hull_of(vertices, 8);
        Touches touches;
        detail::contacts::touch_hull(hull, lattice_triangle(triangle), {}, hull.size, touches);
        CAPTURE(i);
        REQUIRE(touches.count != 0);
        const double size = static_cast<double>(hull.size),
                     off = std::abs(static_cast<double>(touches.nearest) - expected);
        worst = std::max(worst, off / size);
        REQUIRE(off <= size * 0x1p-18);
    }
    MESSAGE(count, " hulls; worst error ", worst, " of the size");
}

}  // namespace
}  // namespace espalier::tests::touch_hull_test
