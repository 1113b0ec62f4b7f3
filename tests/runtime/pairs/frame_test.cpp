// Claims about the common grid of two blobs: how far placing moves a vertex, in rational arithmetic.
#include "support/testing.hpp"

#include <runtime/pairs/frame.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/queries/placement_maker.hpp"

namespace espalier::tests::frame_test {
namespace {

using Exact3 = std::array<Rational, 3>;

/// The point of b in a's lattice steps, without any rounding.
Exact3 placed_exactly(const DecodedBlob& a, const DecodedBlob& b, const Transform& placement, const GridPoint& v) {
    const Rational x = Rational::of(placement.rotation.x), y = Rational::of(placement.rotation.y),
                   z = Rational::of(placement.rotation.z), w = Rational::of(placement.rotation.w);
    const Rational s = Rational(2) / (x * x + y * y + z * z + w * w);
    const Rational one = 1;
    const std::array<Exact3, 3> rotation = {{{one - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                                             {s * (x * y + w * z), one - s * (x * x + z * z), s * (y * z - w * x)},
                                             {s * (x * z - w * y), s * (y * z + w * x), one - s * (x * x + y * y)}}};
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
