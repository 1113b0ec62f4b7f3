// Claims about what a small core sees along a ray (seen_ray.hpp): to the bit as it was, never less than the ray meets,
// and at their slack to the last unit.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <runtime/seen_boxes.hpp>
#include <runtime/seen_triangles.hpp>

#include "../platform/fingerprint.hpp"
#include "../support/boxes_on_ray.hpp"

using namespace espalier;
using namespace espalier::tests;
using platform::Fingerprint;

namespace {

detail::SeenRay look_along(const detail::IntegerRay& rounded, const detail::BlobData& asset) {
    detail::SeenRay ray;
    static_cast<detail::IntegerRay&>(ray) = rounded;
    ray.look_ahead(asset);
    return ray;
}

detail::SeenVertex seen_vertex(std::int32_t x, std::int32_t y) {
    return (static_cast<std::uint32_t>(x) & 0xFFFFu) | static_cast<std::uint32_t>(y) << 16;
}

using Seen = detail::SeenChildren<detail::PackedNode>;

std::int32_t cross(std::array<std::int32_t, 2> p, std::array<std::int32_t, 2> q) { return p[0] * q[1] - p[1] * q[0]; }

}  // namespace

TEST_SUITE("seen ray") {
    TEST_CASE("small code: rays and boxes and vertices convert to the recorded bits") {
        Fingerprint sum;
        std::uint32_t rays = 0, met = 0, missed = 0;
        const auto look = [&](const detail::BlobData& asset, const EightBoxes& boxes, const detail::IntegerRay& rounded,
                              Random& random) {
            const detail::SeenRay ray = look_along(rounded, asset);
            ++rays;
            for (const std::int32_t slope : ray.slope) sum.add(static_cast<std::uint32_t>(slope));
            sum.add(static_cast<std::uint32_t>(ray.first_ahead));
            sum.add(static_cast<std::uint32_t>(ray.base_shift));
            sum.add(ray.ahead_per_tau);
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
            sum.add(static_cast<std::uint32_t>(leaf.finer));
            sum.add(static_cast<std::uint32_t>(leaf.error));
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
                [&](const detail::BlobData& asset, const Boxes& boxes, const detail::IntegerRay& rounded,
                    Random& random) {
                    const detail::SeenRay ray = look_along(rounded, asset);
                    const std::int32_t limit = random.coin() ? ray.last_ahead(ray.tau_max)
                                                             : random.between(0, asset.extent[0] << ray.fraction_bits);
                    const unsigned seen =
                        detail::seen_children(ray, boxes.node, limit, Boxes::every_child) & Boxes::every_child;
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
        detail::BlobData asset;
        asset.bits = 16;
        asset.derive();
        for (unsigned ahead = 0; ahead < 3; ++ahead)
            for (unsigned beside = 1; beside < 3; ++beside)
                for (const std::int32_t sign : {-1, 1}) {
                    // A point at the lattice's origin, among planes so far apart that a finest unit is half of the
                    // ray's: what is seen is within 2 * 4 + 258 of these, which 133 of the ray's are.
                    EightBoxes boxes;
                    boxes.set_shifts({13, 13, 13});
                    const unsigned axis = (ahead + beside) % 3;
                    for (const std::int32_t away : {0, 132, 133, 134, 135}) {
                        detail::IntegerRay rounded{};
                        detail::set_longest_axis(rounded, ahead);
                        rounded.fraction_bits = 6;
                        rounded.direction[ahead] = sign * (1 << 23);
                        rounded.origin[ahead] = -sign * 1000;
                        rounded.tau_max = detail::infinity;
                        for (const std::int32_t side : {-away, away}) {
                            rounded.origin[axis] = side;
                            const detail::SeenRay ray = look_along(rounded, asset);
                            const unsigned seen =
                                detail::seen_children(ray, boxes.node, ray.last_ahead(ray.tau_max), 255);
                            CAPTURE(side);
                            CHECK(Seen::children(seen) == (away <= 133 ? 255u : 0u));
                        }
                    }
                }
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
                const bool expected = *std::min_element(edges, edges + 3) >= -leaf.error ||
                                      *std::max_element(edges, edges + 3) <= leaf.error;
                allowed += expected ? 1u : 0u;
                CHECK(leaf.allows(seen_vertex(at[2][0], at[2][1]), seen_vertex(at[0][0], at[0][1]),
                                  seen_vertex(at[1][0], at[1][1])) == expected);
            }
        }
        CHECK(allowed > 1'000);
    }
}
