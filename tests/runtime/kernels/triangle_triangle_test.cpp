// Claims about the kernel of two triangles, against the convex hull of their differences in exact arithmetic.
#include "support/testing.hpp"

#include <sstream>

#include <runtime/kernels/triangle_triangle.hpp>

#include "oracle/big_integer.hpp"
#include "oracle/convex_hull.hpp"

namespace espalier::tests::triangle_triangle_test {
namespace {

using detail::Integer3;
using detail::IntegerTriangle;
using oracle::BigInteger;

template <class Number>
bool meet_in_truth(const IntegerTriangle& p, const IntegerTriangle& q) {
    const auto points = [](const IntegerTriangle& t) {
        std::vector<oracle::WholePoint<Number>> result;
        for (const Integer3& v : t.corner) result.push_back({Number(v.x), Number(v.y), Number(v.z)});
        return result;
    };
    return oracle::hulls_meet(points(p), points(q));
}

/// Triangle number `number` of those with corners in a grid of that many points along the axes.
IntegerTriangle nth_triangle(std::uint32_t number, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    IntegerTriangle t;
    for (Integer3& v : t.corner) {
        v = {number % x, number / x % y, number / x / y % z};
        number /= x * y * z;
    }
    return t;
}

std::string describe(const IntegerTriangle& t) {
    std::ostringstream text;
    for (const Integer3& v : t.corner) text << '(' << v.x << ' ' << v.y << ' ' << v.z << ") ";
    return text.str();
}

Integer3 moved(const Integer3& v, const Integer3& by) { return {v.x + by.x, v.y + by.y, v.z + by.z}; }

/// Pairs that nearly touch, or do: corners of one on corners, sides and faces of the other, up to a step.
struct HardPairs {
    Random random;

    std::int64_t coordinate(unsigned bits) {
        const auto word = static_cast<std::int64_t>(random.next() >> (64 - bits));
        return word - (std::int64_t{1} << (bits - 1));
    }
    Integer3 point(unsigned bits) {
        const std::int64_t x = coordinate(bits), y = coordinate(bits);
        return {x, y, random.below(4) == 0 ? 0 : coordinate(bits)};
    }
    Integer3 nudge() { return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)}; }
    IntegerTriangle triangle(unsigned bits) {
        IntegerTriangle t = {{point(bits), point(bits), point(bits)}};
        const std::uint32_t kind = random.below(12);
        if (kind == 0) t.corner[2] = t.corner[random.below(2)];
        if (kind == 1) {  // three points of a line
            const Integer3 step = point(bits > 4 ? bits - 4 : 1);
            t.corner[1] = moved(t.corner[0], step);
            t.corner[2] = moved(t.corner[1], step);
        }
        if (kind == 2) t.corner[0] = t.corner[1] = t.corner[2];
        return t;
    }
    /// On the triangle, or a step beside it: on a corner, near the middle of a side, inside.
    Integer3 point_of(const IntegerTriangle& t) {
        const Integer3 &a = t.corner[random.below(3)], &b = t.corner[random.below(3)], &c = t.corner[random.below(3)];
        const Integer3 on =
            random.coin() ? Integer3{(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2}
                          : Integer3{(a.x + b.x + 2 * c.x) / 4, (a.y + b.y + 2 * c.y) / 4, (a.z + b.z + 2 * c.z) / 4};
        return random.coin() ? on : moved(on, nudge());
    }
    void pair(unsigned bits, IntegerTriangle& p, IntegerTriangle& q) {
        p = triangle(bits);
        q = triangle(bits);
        const std::uint32_t kind = random.below(8);
        if (kind >= 1) q.corner[0] = point_of(p);
        if (kind >= 4) q.corner[1] = point_of(p);
        if (kind >= 7) q.corner[2] = point_of(p);
        if (kind == 3) {  // a point of a side on a point of a side
            const Integer3 on = q.corner[0], to = q.corner[1];
            q.corner[2] = {2 * on.x - to.x, 2 * on.y - to.y, 2 * on.z - to.z};
        }
        std::swap(q.corner[0], q.corner[random.below(3)]);
        std::swap(q.corner[1], q.corner[random.below(3)]);
        if (random.coin()) std::swap(p, q);
    }
};

TEST_CASE("kernel: every pair of triangles in the smallest grids equals the hull of differences") {
    std::uint64_t decided = 0;
    struct Grid {
        std::uint32_t x, y, z, stride;
    };
    // All pairs in the corners of a cube and in a plane of 2 x 3, with and without area; of larger grids a share.
    for (const Grid& grid : {Grid{2, 2, 2, 1}, Grid{2, 3, 1, 1}, Grid{4, 4, 1, 97}, Grid{3, 3, 3, 2477}}) {
        const std::uint32_t points = grid.x * grid.y * grid.z;
        const std::uint32_t count = points * points * points;
        const std::uint64_t stride = std::max<std::uint64_t>(grid.stride / scaled(1), 1);
        std::uint64_t meeting = 0, checked = 0;
        for (std::uint64_t i = 0; i < std::uint64_t{count} * count; i += stride) {
            const auto first = static_cast<std::uint32_t>(i / count);
            const auto second = static_cast<std::uint32_t>(i % count);
            const IntegerTriangle p = nth_triangle(first, grid.x, grid.y, grid.z);
            const IntegerTriangle q = nth_triangle(second, grid.x, grid.y, grid.z);
            const bool expected = meet_in_truth<std::int64_t>(p, q);
            ++decided;
            if (detail::triangles_meet(p, q) != expected) FAIL(describe(p), "and ", describe(q));
            meeting += expected ? 1u : 0u;
            ++checked;
        }
        CHECK(meeting > checked / 10);
        CHECK(meeting < checked);
    }
    MESSAGE(decisions_made("two triangles", decided));
}

TEST_CASE("kernel: pairs of triangles that touch or nearly touch are decided exactly at every size") {
    std::uint64_t decided = 0;
    HardPairs maker{Random(11)};
    std::uint64_t meeting = 0;
    const std::uint64_t count = scaled(3'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        IntegerTriangle p, q;
        maker.pair(3 + maker.random.below(35), p, q);
        const bool expected = meet_in_truth<BigInteger>(p, q);
        ++decided;
        if (detail::triangles_meet(p, q) != expected) FAIL(describe(p), "and ", describe(q));
        meeting += expected ? 1u : 0u;
    }
    CHECK(meeting > count / 10);
    CHECK(meeting < count - count / 10);
    MESSAGE(decisions_made("two triangles", decided));
}

TEST_CASE("kernel: small pairs far away and pairs at the edge of the fast path are decided alike") {
    HardPairs maker{Random(12)};
    const std::uint64_t count = scaled(3'000);
    for (std::uint64_t i = 0; i < count; ++i) {
        IntegerTriangle p, q;
        maker.pair(i % 2 == 0 ? 19 + maker.random.below(3) : 4, p, q);
        const bool expected = detail::triangles_meet(p, q);
        if (i % 2 == 0) REQUIRE(meet_in_truth<BigInteger>(p, q) == expected);
        const Integer3 by = {std::int64_t{1} << 60, -(std::int64_t{1} << 61), 12345};
        for (IntegerTriangle* t : {&p, &q})
            for (Integer3& v : t->corner) v = moved(v, by);
        REQUIRE(detail::triangles_meet(p, q) == expected);
        std::swap(p.corner[0], p.corner[2]);  // neither winding nor order matters
        REQUIRE(detail::triangles_meet(q, p) == expected);
    }
}

}  // namespace
}  // namespace espalier::tests::triangle_triangle_test
