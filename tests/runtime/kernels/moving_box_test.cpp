// The kernel of moving boxes: the tick of the first contact, exactly, and the contact itself, against the oracle,
// which solves linear programs in rational numbers.
#include "support/testing.hpp"

#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/point_triangle.hpp>

#include "moving_scene.hpp"
#include "oracle/exact_geometry.hpp"
#include "oracle/rational.hpp"

namespace espalier::tests::moving_box_test {
namespace {

using namespace espalier::tests::moving;
using detail::MovingBox;
using oracle::BigInteger;

Case<MovingBox> some_box(Random& random) {
    for (;;) {
        Scene scene(random);
        const Integer3 way = scene.some_way();
        Integer3 size = {scene.some_radius(), scene.some_radius(), scene.some_radius()};
        const Integer3 low =
            minus(scene.some_start(scene.some_target(), way, size.x), random.coin() ? size : Integer3{});
        const Integer3 high = plus(low, size);
        constexpr std::int64_t limit = std::int64_t{1} << 34;
        if (is_below(low, limit) && is_below(high, limit)) return {{low, high, way}, scene.triangle};
    }
}

/// Minimises tau over all u, v, tau with a point of the triangle in the moved box: at a corner of that polytope, where
/// three of its planes meet. Its planes: normal * (u, v, tau) <= bound.
std::optional<Rational> exact_first_contact(const Case<MovingBox>& c) {
    struct Plane {
        std::array<BigInteger, 3> normal;
        BigInteger bound;
    };
    std::vector<Plane> planes = {{{-1, 0, 0}, 0}, {{0, -1, 0}, 0}, {{1, 1, 0}, 1}, {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};
    for (const auto axis : axes) {
        const auto& t = c.triangle.corner;
        const BigInteger u = t[1].*axis - t[0].*axis, v = t[2].*axis - t[0].*axis, way = c.moving.displacement.*axis;
        planes.push_back({{u, v, -way}, c.moving.high.*axis - t[0].*axis});
        planes.push_back({{-u, -v, way}, t[0].*axis - c.moving.low.*axis});
    }
    const auto determinant = [](const std::array<BigInteger, 3>& a, const std::array<BigInteger, 3>& b,
                                const std::array<BigInteger, 3>& d) {
        return a[0] * (b[1] * d[2] - b[2] * d[1]) - a[1] * (b[0] * d[2] - b[2] * d[0]) +
               a[2] * (b[0] * d[1] - b[1] * d[0]);
    };
    std::optional<std::pair<BigInteger, BigInteger>> least;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                const Plane* three[3] = {&planes[i], &planes[j], &planes[k]};
                BigInteger whole = determinant(three[0]->normal, three[1]->normal, three[2]->normal);
                if (whole.is_zero()) continue;
                std::array<BigInteger, 3> at;
                for (unsigned column = 0; column < 3; ++column) {
                    std::array<BigInteger, 3> rows[3] = {three[0]->normal, three[1]->normal, three[2]->normal};
                    for (unsigned row = 0; row < 3; ++row) rows[row][column] = three[row]->bound;
                    at[column] = determinant(rows[0], rows[1], rows[2]);
                }
                if (whole.is_negative()) {
                    whole = -whole;
                    for (BigInteger& coordinate : at) coordinate = -coordinate;
                }
                const bool is_inside = std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
                    return plane.normal[0] * at[0] + plane.normal[1] * at[1] + plane.normal[2] * at[2] <=
                           plane.bound * whole;
                });
                if (is_inside && (!least || at[2] * least->second < least->first * whole)) least = {at[2], whole};
            }
    if (!least) return std::nullopt;
    return Rational(least->first, least->second);
}

TEST_CASE("kernel: a moving box touches first at the tick of the oracle") {
    std::uint64_t decided = 0, along_axes = 0;
    Random random(5);
    std::array<std::uint64_t, 3> seen{};
    const std::uint64_t count = scaled(1'500);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Case<MovingBox> c = some_box(random);
        const SweepTick tick = first_contact_tick(c.moving, c.triangle, whole_way);
        const std::optional<Rational> time = exact_first_contact(c);
        CAPTURE(i);
        ++decided;
        require_right_limits(c, tick, random, seen);
        if (!require_tick(time, tick)) continue;

        // The normal separates, and looks against the way.
        const SweepContact contact = contact_at(c.moving, c.triangle, tick);
        const Point way = exact(c.moving.displacement), normal = require_normal(contact, way);
        const Point moved = way * ticks(tick - 1);
        Rational of_box = normal.dot(moved);
        Rational size = 0;
        for (int k = 0; k < 3; ++k) {
            const auto axis = axes[k];
            const std::int64_t low = c.moving.low.*axis, high = c.moving.high.*axis;
            of_box += normal[k] * Rational(normal[k].sign() > 0 ? low : high);
            size = std::max(
                {size, oracle::absolute(Rational(low) + moved[k]), oracle::absolute(Rational(high) + moved[k])});
        }
        Rational of_triangle = normal.dot(exact(c.triangle.corner[0]));
        for (const Integer3& corner : c.triangle.corner) {
            of_triangle = std::max(of_triangle, normal.dot(exact(corner)));
            for (const auto axis : axes) size = std::max(size, oracle::absolute(Rational(corner.*axis)));
        }
        REQUIRE(of_box >= of_triangle - size * Rational::of(1, -20));

        // The point lies on the triangle and in the box, as far as the header says.
        const Point point = weighted(c.triangle, contact);
        REQUIRE(contact.u >= -0x1p-20f);
        REQUIRE(contact.v >= -0x1p-20f);
        REQUIRE(contact.u + contact.v <= 1.0f + 0x1p-20f);
        // The feature is what is nearest along the normal, which is exact along a coordinate axis.
        const float along[3] = {contact.normal.x, contact.normal.y, contact.normal.z};
        for (int k = 0; k < 3; ++k) {
            if (std::fabs(along[k]) != 1.0f || along[(k + 1) % 3] != 0.0f || along[(k + 2) % 3] != 0.0f) continue;
            ++along_axes;
            std::int64_t nearest = c.triangle.corner[0].*axes[k];
            for (const Integer3& corner : c.triangle.corner)
                nearest = along[k] > 0.0f ? std::max(nearest, corner.*axes[k]) : std::min(nearest, corner.*axes[k]);
            for (unsigned corner = 0; corner < 3; ++corner)
                REQUIRE((detail::corners_of(contact.feature) >> corner & 1u) ==
                        (c.triangle.corner[corner].*axes[k] == nearest ? 1u : 0u));
        }
        for (int k = 0; k < 3; ++k) {
            const auto axis = axes[k];
            const Rational low = Rational(c.moving.low.*axis) + moved[k];
            const Rational high = Rational(c.moving.high.*axis) + moved[k];
            Rational largest = 0;
            for (const Integer3& corner : c.triangle.corner)
                largest = std::max({largest, oracle::absolute(Rational(corner.*axis) - low),
                                    oracle::absolute(Rational(corner.*axis) - high)});
            const Rational grown = oracle::absolute(way[k]) * ticks(1) + largest * Rational::of(1, -19);
            REQUIRE(point[k] >= low - grown);
            REQUIRE(point[k] <= high + grown);
        }
    }
    for (const std::uint64_t number : seen) CHECK(number > count / 20);
    CHECK(along_axes > count / 20);
    MESSAGE(decisions_made("box that moves", decided));
}

}  // namespace
}  // namespace espalier::tests::moving_box_test
