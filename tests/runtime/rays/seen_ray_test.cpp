// Claims about what a small core sees along a ray (seen_ray.hpp): to the bit as it was, never less than the ray meets,
// and at their slack to the last unit.
#include "support/testing.hpp"

#include <type_traits>

#include <runtime/rays/small_code/seen_boxes.hpp>

#include "platform/fingerprint.hpp"
#include "support/exact/boxes_on_ray.hpp"

namespace espalier::tests::seen_ray_test {
namespace {

using platform::Fingerprint;

template <class Seen = detail::SeenRay>
Seen look_along(const detail::IntegerRay& rounded, const detail::BlobData& asset) {
    Seen ray;
    static_cast<detail::IntegerRay&>(ray) = rounded;
    CHECK(ray.prepare(asset));
    return ray;
}

detail::BlobData asset_of(int bits) {
    detail::BlobData asset;
    asset.bits = static_cast<std::uint8_t>(bits);
    asset.derive();
    return asset;
}

/// From the lattice's origin along an axis, without an end.
detail::IntegerRay ray_along(unsigned axis, std::int32_t sign) {
    detail::IntegerRay ray{};
    detail::set_longest_axis(ray, axis);
    ray.direction[axis] = sign * (1 << 23);
    ray.tau_max = infinity;
    return ray;
}

/// Returns the children whose boxes the ray may meet.
template <class Boxes>
unsigned children_met(const detail::IntegerRay& rounded, const detail::BlobData& asset, const Boxes& boxes,
                      std::int32_t last_ahead, unsigned among) {
    std::conditional_t<Boxes::children == 8, detail::SeenRay, detail::SeenPlainRay> ray;
    static_cast<detail::IntegerRay&>(ray) = rounded;
    return ray.prepare(asset) ? detail::seen_children(ray, boxes.node, last_ahead, among) & Boxes::every_child : 0;
}

detail::SeenVertex seen_vertex(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint32_t>(x) & 0xFFFFu) | static_cast<std::uint32_t>(y) << 16;
}

using Seen = detail::SeenChildren<detail::PackedNode>;

std::int32_t cross(std::array<std::int32_t, 2> p, std::array<std::int32_t, 2> q) { return p[0] * q[1] - p[1] * q[0]; }

TEST_CASE("small code: rays and boxes and vertices convert to the recorded bits") {
    Fingerprint sum;
    std::uint32_t rays = 0, met = 0, missed = 0;
    const auto look = [&](const detail::BlobData& asset, const EightBoxes& boxes, const detail::IntegerRay& rounded,
                          Random& random) {
        const detail::SeenRay ray = look_along(rounded, asset);
        ++rays;
        for (const std::int32_t slope : ray.slope) sum.add(static_cast<std::uint32_t>(slope));
        sum.add(static_cast<std::uint32_t>(ray.first_ahead));
        sum.add(static_cast<std::uint32_t>(ray.base_shift), ray.ahead_per_tau);
        for (const float tau : {0.0f, 0x1p-24f, 1.0f, ray.tau_min, ray.tau_max})
            sum.add(static_cast<std::uint32_t>(ray.last_ahead(tau)));
        for (int k = 0; k < 2; ++k) {
            const unsigned among = k == 0 ? 255u : 1u + random.below(255);
            const std::int32_t limit = k == 0 ? ray.last_ahead(ray.tau_max) : random.between(-5, 1 << 24);
            const unsigned seen = detail::seen_children(ray, boxes.node, limit, among);
            sum.add(Seen::children(seen));
            if (Seen::children(seen) != 0) sum.add(Seen::nearest(seen));
            (Seen::children(seen) != 0 ? met : missed) += 1;
        }
        const detail::SeenLeaf leaf(random.between(0, 31));
        sum.add(static_cast<std::uint32_t>(leaf.finer), static_cast<std::uint32_t>(leaf.error));
        std::int32_t place[3];
        for (std::int32_t& coordinate : place) coordinate = random.between(-(1 << 24), 1 << 24);
        sum.add(leaf.vertex(ray, place[ray.axis[0]], place[ray.axis[1]], place[ray.axis[2]]));
    };
    for_each_ray<EightBoxes>(400, true, look);
    for_each_ray<EightBoxes>(100, false, look);
    CHECK(rays > 25'000);
    CHECK(met > 10'000);
    CHECK(missed > 10'000);
    CHECK(sum.value() == 7252196268673082634u);
}

TEST_CASE("small code: no box that the ray passes through is left out") {
    for_each_full_node([]<class Boxes>() {
        std::uint32_t passed = 0, rejected = 0;
        for_each_ray<Boxes>(
            100, true,
            [&](const detail::BlobData& asset, const Boxes& boxes, const detail::IntegerRay& rounded, Random& random) {
                const detail::SeenRay ray = look_along(rounded, asset);
                const std::int32_t limit = random.coin() ? ray.last_ahead(ray.tau_max)
                                                         : random.between(0, asset.extent[0] << ray.fraction_bits);
                const unsigned seen = children_met(rounded, asset, boxes, limit, Boxes::every_child);
                for (unsigned child = 0; child < Boxes::children; ++child) {
                    const bool is_seen = (seen >> child & 1u) != 0;
                    rejected += is_seen ? 0u : 1u;
                    if (!passes_exactly(ray, boxes.node, asset.bits, child, &limit)) continue;
                    ++passed;
                    CHECK(is_seen);
                }
            });
        MESSAGE(passed << " boxes passed through, " << rejected << " left out");
        CHECK(passed > 3'000);
        CHECK(rejected > 3'000);
    });
}

TEST_CASE("small code: a box is left out only beyond the reach of rounding") {
    const detail::BlobData asset = asset_of(16);
    for (unsigned ahead = 0; ahead < 3; ++ahead)
        for (unsigned beside = 1; beside < 3; ++beside)
            for (const std::int32_t sign : {-1, 1}) {
                // A point at the lattice's origin, among planes so far apart that a finest unit is half of the
                // ray's: what is seen is within 2 * 4 + 258 of these, which 133 of the ray's are.
                EightBoxes boxes;
                boxes.set_shifts({13, 13, 13});
                const unsigned axis = (ahead + beside) % 3;
                for (const std::int32_t away : {0, 132, 133, 134, 135}) {
                    detail::IntegerRay rounded = ray_along(ahead, sign);
                    rounded.fraction_bits = 6;
                    rounded.origin[ahead] = -sign * 1000;
                    for (const std::int32_t side : {-away, away}) {
                        rounded.origin[axis] = side;
                        const detail::SeenRay ray = look_along(rounded, asset);
                        const unsigned seen = detail::seen_children(ray, boxes.node, ray.last_ahead(ray.tau_max), 255);
                        CAPTURE(side);
                        CHECK(Seen::children(seen) == (away <= 133 ? 255u : 0u));
                    }
                }
            }
}

TEST_CASE("small code: a box of a plain node is left out only beyond the reach of rounding") {
    for (const int bits : {10, 16, 17, 20, 24})
        for (unsigned ahead = 0; ahead < 3; ++ahead)
            for (unsigned beside = 1; beside < 3; ++beside)
                for (const std::int32_t sign : {-1, 1})
                    for (const std::int32_t side_sign : {-1, 1}) {
                        const detail::BlobData asset = asset_of(bits);
                        const int unit = bits > 16 ? bits - 16 : 0;
                        const unsigned middle = 1u << (bits - unit - 1), axis = (ahead + beside) % 3;
                        SixteenBoxes boxes;
                        for (unsigned child = 0; child < 16; ++child)
                            for (std::size_t k = 0; k < 3; ++k) boxes.set_box(k, child, middle, middle);
                        detail::IntegerRay rounded = ray_along(ahead, sign);
                        rounded.direction[axis] = side_sign;
                        // Through the middle of the one plane of a child, and so many planes beside it.
                        for (int k = 0; k < 3; ++k)
                            rounded.origin[k] = static_cast<std::int32_t>((2 * middle + 1) << unit) / 2;
                        const std::int32_t at = rounded.origin[axis];
                        for (const std::int32_t away : {-16, -10, 0, 10, 16}) {
                            rounded.origin[axis] = at + away * (1 << unit);
                            CAPTURE(bits);
                            CAPTURE(away);
                            const unsigned seen = children_met(rounded, asset, boxes, 1 << 24, 0xFFFFu);
                            if (away == 0) CHECK(seen == 0xFFFFu);
                            if (away == 16 || away == -16) CHECK(seen == 0);
                        }
                    }
}

TEST_CASE("small code: a plain node with fewer children has the nearest of those that are left") {
    const detail::BlobData asset = asset_of(16);
    for (unsigned ahead = 0; ahead < 3; ++ahead)
        for (const std::int32_t sign : {-1, 1}) {
            SixteenBoxes boxes;
            for (unsigned child = 0; child < 16; ++child)
                for (std::size_t k = 0; k < 3; ++k)
                    boxes.set_box(k, child, k == ahead ? 1000 * child : 100, k == ahead ? 1000 * child + 500 : 200);
            detail::IntegerRay rounded = ray_along(ahead, sign);
            for (int k = 0; k < 3; ++k) rounded.origin[k] = 150;
            rounded.origin[ahead] = sign > 0 ? -10 : 20'000;
            const auto ray = look_along<detail::SeenPlainRay>(rounded, asset);
            using SeenPlain = detail::SeenChildren<detail::PlainNode>;
            for (unsigned child = 0; child < 16; ++child) {
                const unsigned left = sign > 0 ? 0xFFFFu << child & 0xFFFFu : (2u << child) - 1;
                const unsigned seen = detail::seen_children(ray, boxes.node, 1 << 24, left);
                CHECK(SeenPlain::children(seen) == left);
                CHECK(SeenPlain::nearest(seen) == child);
                // No farther than just before a child's first plane, or just at it.
                const std::int32_t first = sign > 0 ? static_cast<std::int32_t>(1000 * child) + 10
                                                    : 20'000 - static_cast<std::int32_t>(1000 * child + 500);
                CHECK((detail::seen_children(ray, boxes.node, first, left) >> child & 1u) == 1);
                CHECK((detail::seen_children(ray, boxes.node, first - 1, left) >> child & 1u) == 0);
            }
        }
}

TEST_CASE("small code: a plain node is met where a ray enters it across") {
    const detail::BlobData asset = asset_of(16);
    constexpr std::int32_t most = 65'535;
    for (unsigned ahead = 0; ahead < 3; ++ahead)
        for (unsigned beside = 1; beside < 3; ++beside)
            for (const bool down_ahead : {false, true})
                for (const bool down : {false, true}) {
                    // Half a step across for each ahead, from a corner of the lattice.
                    const unsigned axis = (ahead + beside) % 3;
                    detail::IntegerRay rounded = ray_along(ahead, down_ahead ? -1 : 1);
                    rounded.direction[axis] = down ? -(1 << 22) : 1 << 22;
                    rounded.origin[ahead] = down_ahead ? most : 0;
                    rounded.origin[axis] = down ? most : 0;
                    const auto ray = look_along<detail::SeenPlainRay>(rounded, asset);
                    SixteenBoxes boxes;
                    for (unsigned child = 0; child < 16; ++child) {
                        const unsigned side = 30'000 - 1000 * child;
                        for (std::size_t k = 0; k < 3; ++k) boxes.set_box(k, child, 0, most);
                        boxes.set_box(axis, child, down ? 0 : side, down ? most - side : most);
                    }
                    for (unsigned child = 0; child < 16; ++child) {
                        const std::int32_t enters = 60'000 - 2000 * static_cast<std::int32_t>(child);
                        const auto is_met = [&](std::int32_t limit) {
                            return (detail::seen_children(ray, boxes.node, limit, 0xFFFFu) >> child & 1u) != 0;
                        };
                        CHECK(is_met(enters));
                        CHECK_FALSE(is_met(enters - 40));
                    }
                    using SeenPlain = detail::SeenChildren<detail::PlainNode>;
                    CHECK(SeenPlain::nearest(detail::seen_children(ray, boxes.node, 1 << 24, 0xFFFFu)) == 15);
                    CHECK(SeenPlain::nearest(detail::seen_children(ray, boxes.node, 1 << 24, 0x0FFFu)) == 11);
                }
}

TEST_CASE("small code: a ray that starts behind a box of a plain node does not meet it") {
    const detail::BlobData asset = asset_of(16);
    for (const std::int32_t sign : {-1, 1}) {
        SixteenBoxes boxes;
        for (unsigned child = 0; child < 16; ++child)
            for (std::size_t k = 0; k < 3; ++k) boxes.set_box(k, child, 1000, 2000);
        detail::IntegerRay rounded = ray_along(2, sign);
        for (int k = 0; k < 2; ++k) rounded.origin[k] = 1500;
        for (const std::int32_t beyond : {0, 4, 5, 100}) {
            rounded.origin[2] = sign > 0 ? 2000 + beyond : 1000 - beyond;
            CHECK((children_met(rounded, asset, boxes, 1 << 24, 0xFFFFu) != 0) == (beyond <= 4));
        }
    }
}

TEST_CASE("small code: a quotient bit by bit equals that of a division") {
    Random random(11);
    for (int i = 0; i < 100'000; ++i) {
        const std::int32_t b = 1 + static_cast<std::int32_t>(random.below(1u << random.below(15)));
        const auto a = 1 + static_cast<std::int32_t>(random.below((static_cast<unsigned>(b) << 16) - 1));
        CHECK(detail::quotient_by_bits<16>(a, b) == a / b);
        const std::int32_t wide = 1 + static_cast<std::int32_t>(random.below(1u << random.below(23)));
        const auto most = 1 + static_cast<std::int32_t>(random.below((static_cast<unsigned>(wide) << 8) - 1));
        CHECK(detail::quotient_by_bits<8>(most, wide) == most / wide);
    }
    CHECK(detail::quotient_by_bits<16>((1 << 30) - 1, 1 << 14) == 65535);
    CHECK(detail::quotient_by_bits<8>((1 << 28) - 1, 1 << 20) == 255);
}

TEST_CASE("small code: a triangle is left out only beyond the error of its rounded corners") {
    Random random(7);
    std::uint32_t allowed = 0;
    for (int bits = 0; bits < 30; bits += 2) {
        const detail::SeenLeaf leaf(bits);
        for (int i = 0; i < 2'000; ++i) {
            // One edge function just so, the others of either sign.
            const std::int32_t beyond = random.between(-1, 1);
            const std::int32_t u = (random.coin() ? 1 : -1) * (leaf.error + beyond);
            std::array<std::array<std::int32_t, 2>, 3> at{};  // b, c, a
            at[0] = {random.between(-2'000, 2'000), 1};
            at[1][1] = random.between(-12, 12);
            at[1][0] = at[0][0] * at[1][1] - u;
            if (at[1][0] < -0x8000 || at[1][0] > 0x7FFF) {
                at[0] = {random.between(-0x4000, 0x4000), 1};
                at[1][1] = at[0][0] == 0 ? 0 : u / at[0][0];
                at[1][0] = at[0][0] * at[1][1] - u;
                if (at[1][0] < -0x8000 || at[1][0] > 0x7FFF || at[1][1] < -0x8000 || at[1][1] > 0x7FFF) continue;
            }
            at[2] = {random.between(-0x4000, 0x3FFF), random.between(-0x4000, 0x3FFF)};
            const std::size_t turned = random.below(3);
            std::rotate(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(turned), at.end());
            const std::int32_t edges[3] = {cross(at[0], at[1]), cross(at[1], at[2]), cross(at[2], at[0])};
            const bool expected =
                *std::min_element(edges, edges + 3) >= -leaf.error || *std::max_element(edges, edges + 3) <= leaf.error;
            allowed += expected ? 1u : 0u;
            CHECK(leaf.allows(seen_vertex(at[2][0], at[2][1]), seen_vertex(at[0][0], at[0][1]),
                              seen_vertex(at[1][0], at[1][1])) == expected);
        }
    }
    CHECK(allowed > 1'000);
}

}  // namespace
}  // namespace espalier::tests::seen_ray_test
