// Claims about the common grid of two blobs: how far placing moves a vertex, in rational arithmetic.
#include "support/testing.hpp"

#include <runtime/pairs/frame.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::frame_test {
namespace {

using Exact3 = std::array<Rational, 3>;

std::array<Exact3, 3> exact_rotation(const Quaternion& rotation) {
    const Rational x = Rational::of(rotation.x), y = Rational::of(rotation.y), z = Rational::of(rotation.z),
                   w = Rational::of(rotation.w);
    const Rational s = Rational(2) / (x * x + y * y + z * z + w * w);
    const Rational one = 1;
    return {{{one - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
             {s * (x * y + w * z), one - s * (x * x + z * z), s * (y * z - w * x)},
             {s * (x * z - w * y), s * (y * z + w * x), one - s * (x * x + y * y)}}};
}

/// The point of b in a's lattice steps, without any rounding.
Exact3 placed_exactly(const DecodedBlob& a, const DecodedBlob& b, const Transform& placement, const GridPoint& v) {
    const std::array<Exact3, 3> rotation = exact_rotation(placement.rotation);
    const std::array<float, 3> moved = {placement.translation.x, placement.translation.y, placement.translation.z};
    Exact3 point;
    for (std::size_t k = 0; k < 3; ++k) {
        point[k] = Rational::of(moved[k]) - Rational::of(a.origin[k]);
        for (std::size_t j = 0; j < 3; ++j)
            point[k] += Rational::of(placement.scale) * rotation[k][j] *
                        (Rational::of(b.origin[j]) + Rational::of(std::int64_t{v[j]}, b.step_exponent));
        point[k] = point[k] * Rational::of(1, -a.step_exponent);
    }
    return point;
}

/// How far apart two sets of points are along an axis; below zero where they overlap.
Rational gap_along(const Exact3& axis, std::span<const Exact3> a, std::span<const Exact3> b) {
    const auto range = [&](std::span<const Exact3> points) {
        std::array<Rational, 2> ends;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Rational at = points[i][0] * axis[0] + points[i][1] * axis[1] + points[i][2] * axis[2];
            if (i == 0 || at < ends[0]) ends[0] = at;
            if (i == 0 || ends[1] < at) ends[1] = at;
        }
        return ends;
    };
    const auto of_a = range(a), of_b = range(b);
    return std::max(of_b[0] - of_a[1], of_a[0] - of_b[1]);
}

/// Along the axes of both bounds, in a's lattice steps.
Rational gap_of_bounds(const TestBlob& a, const TestBlob& b, const Transform& placement) {
    std::array<Exact3, 8> of_a, of_b;
    for (unsigned i = 0; i < 8; ++i) {
        GridPoint corner;
        for (unsigned k = 0; k < 3; ++k) {
            corner[k] = (i >> k & 1u) != 0 ? detail::data_of(b.opened.blob).extent[k] : 0;
            of_a[i][k] = std::int64_t{(i >> k & 1u) != 0 ? detail::data_of(a.opened.blob).extent[k] : 0};
        }
        of_b[i] = placed_exactly(a.decoded, b.decoded, placement, corner);
    }
    const std::array<Exact3, 3> rotation = exact_rotation(placement.rotation);
    Rational gap = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        Exact3 unit = {0, 0, 0};
        unit[k] = 1;
        gap = std::max(gap, gap_along(unit, of_a, of_b));
        gap = std::max(gap, gap_along({rotation[0][k], rotation[1][k], rotation[2][k]}, of_a, of_b));
    }
    return gap;
}

/// The coordinates of both bounds and of the placement, added up, in a's lattice steps.
Rational size_of_bounds(const TestBlob& a, const TestBlob& b, const Transform& placement) {
    Rational size = 0;
    const std::array<float, 3> moved = {placement.translation.x, placement.translation.y, placement.translation.z};
    for (std::size_t k = 0; k < 3; ++k) {
        const Rational own = Rational::of(std::int64_t{a.decoded.extent[k]}, a.decoded.step_exponent),
                       other = Rational::of(std::int64_t{b.decoded.extent[k]}, b.decoded.step_exponent);
        size += oracle::absolute(Rational::of(moved[k])) + oracle::absolute(Rational::of(a.decoded.origin[k])) + own +
                Rational::of(placement.scale) * (oracle::absolute(Rational::of(b.decoded.origin[k])) + other);
    }
    return size * Rational::of(1, -a.decoded.step_exponent);
}

TEST_CASE("pair: bounds are called apart only where they are and wherever they clearly are") {
    const std::vector<TestBlob>& blobs = small_test_blobs();
    std::uint64_t apart = 0, near = 0;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const TestBlob& a = blobs[i];
        const TestBlob& b = blobs[(i + 4) % blobs.size()];
        const detail::BlobData &data_a = detail::data_of(a.opened.blob), &data_b = detail::data_of(b.opened.blob);
        PlacementMaker maker(a.decoded, b.decoded, 70 + i);
        for (std::uint64_t n = 0; n < scaled(20); ++n) {
            const Transform placement = n % 3 == 0 ? maker.adversarial() : n % 3 == 1 ? maker.apart() : maker.random();
            CAPTURE(describe(placement));
            const float step = std::ldexp(1.0f, a.decoded.step_exponent);
            const auto longest = static_cast<float>(std::max({data_a.extent[0], data_a.extent[1], data_a.extent[2]}));
            const float distance = n % 2 == 0 ? 0.0f : longest * maker.numbers().unit();  // in steps
            const Rational gap = gap_of_bounds(a, b, placement) - Rational::of(distance);
            const bool are_apart = detail::are_apart(data_a, data_b, placement, distance * step);
            // By more than the two meshes move on their common grid.
            const Rational size = size_of_bounds(a, b, placement);
            if (are_apart) REQUIRE(Rational::of(1, -6) + size * Rational::of(1, -17) < gap);
            const bool is_clear = Rational(1) + size * Rational::of(1, -12) < gap && size < Rational::of(1, 60);
            if (distance == 0.0f && is_clear) REQUIRE(are_apart);
            (are_apart ? apart : near) += 1;
        }
    }
    CHECK(apart > 0);
    CHECK(near > 0);
}

TEST_CASE("pair: bounds of the smallest steps are not called apart where they overlap") {
    const OpenedBlob cube(make_cube(0.75f, 1.75f), {.resolution = Resolution::step(-2)});
    const OpenedBlob tiny(make_cube(0.0f, 0x1p-100f), {.resolution = Resolution::step(-100)});
    const auto are_apart = [&](const Transform& placement) {
        return detail::are_apart(detail::data_of(cube.blob), detail::data_of(tiny.blob), placement, 0.0f);
    };
    CHECK_FALSE(are_apart({{}, {}, 0x1p100f}));  // the unit cube
    CHECK(are_apart({{}, {3.0f, 0.0f, 0.0f}, 0x1p100f}));
    CHECK_FALSE(are_apart({{}, {3.0f, 0.0f, 0.0f}, 0x1p101f}));  // out of range
}

TEST_CASE("rounding: a vertex of a pair moves by half a step and the rounding of the rotation at most") {
    const std::vector<TestBlob>& blobs = small_test_blobs();
    Rational worst = 0;
    for (std::size_t i = 0; i < blobs.size(); ++i) {
        const TestBlob& a = blobs[i];
        const TestBlob& b = blobs[(i + 4) % blobs.size()];
        PlacementMaker maker(a.decoded, b.decoded, 40 + i);
        for (std::uint64_t n = 0; n < scaled(6); ++n) {
            const Transform placement = n % 2 == 0 ? maker.random() : maker.adversarial();
            CAPTURE(describe(placement));
            detail::PairFrame frame;
            REQUIRE(detail::place_pair(detail::data_of(a.opened.blob), detail::data_of(b.opened.blob), placement,
                                       frame) == QueryStatus::ok);
            // 2^-30 of each of three coordinates, and where it is large, of b's origin.
            Rational origin = 0;
            for (const float x : b.decoded.origin) origin += oracle::absolute(Rational::of(x));
            const Rational far =
                origin * Rational::of(placement.scale) * Rational::of(1, -30 - a.decoded.step_exponent - frame.shift);
            const Rational allowed = Rational(oracle::BigInteger(9), oracle::BigInteger(16)) + far;
            for (int vertex = 0; vertex < 4; ++vertex) {
                const auto& triangles = b.decoded.triangles;
                const GridPoint& v = triangles[maker.numbers().below(static_cast<std::uint32_t>(triangles.size()))].a;
                std::int32_t placed[3];
                frame.place_b(v.data(), placed);
                const Exact3 exact = placed_exactly(a.decoded, b.decoded, placement, v);
                for (std::size_t k = 0; k < 3; ++k) {
                    const Rational error =
                        oracle::absolute(Rational(std::int64_t{placed[k]}) - exact[k] * Rational::of(1, -frame.shift));
                    REQUIRE(error <= allowed);
                    REQUIRE(std::abs(placed[k]) <= (1 << 24));
                    worst = std::max(worst, error / allowed);
                }
                const GridPoint& own = a.decoded.triangles[0].b;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Rational at = Rational(std::int64_t{own[k]}) * Rational::of(1, -frame.shift);
                    const Rational error = oracle::absolute(Rational(std::int64_t{frame.place_a(own[k])}) - at);
                    REQUIRE(error <= Rational(oracle::BigInteger(1), oracle::BigInteger(2)));
                    if (frame.shift <= 0) REQUIRE(error.sign() == 0);
                }
            }
        }
    }
    CHECK(worst > Rational(oracle::BigInteger(1), oracle::BigInteger(2)));
}

}  // namespace
}  // namespace espalier::tests::frame_test
