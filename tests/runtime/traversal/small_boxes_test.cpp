// Claims about boxes that are taken for the surface in them (small_boxes.hpp): exact, on the border and a unit beside
// it.
#include "support/testing.hpp"

#include <runtime/traversal/small_boxes.hpp>

#include "support/blobs/node_kinds.hpp"
#include "support/exact/boxes_on_ray.hpp"

namespace espalier::tests::small_boxes_test {
namespace {

/// Turns the ray so that it meets corners, sides and borders of its window at whole fractions of steps: along an axis
/// or a diagonal, from or to a corner of the child's box, ulps beside it or none.
template <class Boxes>
void turn_to_border(const Boxes& boxes, unsigned bits, unsigned child, Random& random, detail::IntegerRay& ray) {
    for (std::int32_t& way : ray.direction) way = random.between(-1, 1) * (1 << 23);
    ray.direction[random.below(3)] = random.coin() ? 1 << 23 : -(1 << 23);
    const std::int32_t back = random.between(-3, 40) << ray.fraction_bits;
    for (int k = 0; k < 3; ++k) {
        const std::int32_t corner = random.coin() ? boxes.node.low(k, child, bits) : boxes.node.high(k, child, bits);
        ray.origin[k] = (corner << ray.fraction_bits) - (ray.direction[k] >> 23) * back;
        if (random.below(3) == 0) ray.origin[k] += random.between(-1, 1);
    }
    const auto at_corner = static_cast<float>(back) * detail::power_of_two(-ray.fraction_bits - 23);
    const auto beside = [&](float tau) {
        const float moved = random.below(3) == 0   ? std::nextafter(tau, 0.0f)
                            : random.below(2) == 0 ? std::nextafter(tau, infinity)
                                                   : tau;
        return std::max(moved, 0.0f);
    };
    ray.tau_min = random.coin() ? 0.0f : beside(at_corner);
    ray.tau_max = random.coin() ? infinity : std::max(ray.tau_min, beside(at_corner));
}

TEST_CASE("approximate: a ray passes through a small box exactly where exact arithmetic does") {
    for_each_full_node([]<class Boxes>() {
        std::uint32_t passed = 0, missed = 0;
        for_each_ray<Boxes>(
            100, true, [&](const detail::BlobData& asset, const Boxes& boxes, detail::IntegerRay& ray, Random& random) {
                const unsigned child = random.below(Boxes::children);
                if (random.coin()) turn_to_border(boxes, asset.bits, child, random, ray);
                for (unsigned other : {child, random.below(Boxes::children)}) {
                    const bool passes = detail::passes_through(ray, boxes.node, asset.bits, other);
                    (passes ? passed : missed) += 1;
                    CHECK(passes == passes_exactly(ray, boxes.node, asset.bits, other));
                }
            });
        CHECK(passed > 1'000);
        CHECK(missed > 1'000);
    });
}

TEST_CASE("approximate: a ray reaches a node exactly when it passes every box above it") {
    std::uint32_t passed = 0, missed = 0;
    for_each_node_kind([&]<class Node>(Profile profile) {
        const OpenedBlob opened(make_torus(120, 60, 3.0, 1.0),
                                {.resolution = Resolution::bits(11), .profile = profile});
        const detail::BlobData& data = detail::data_of(opened.blob);
        struct Step {
            std::uint32_t parent = 0;
            unsigned child = 0;
        };
        std::vector<Step> steps(data.node_count);
        for (std::uint32_t index = 0; index < data.node_count; ++index) {
            const Node node = detail::node_at<Node>(data, index);
            for (unsigned child = 0; child < node.node_children(); ++child)
                steps[node.first_child() + child] = {index, child};
        }
        Random random(5);
        for (std::uint32_t target = 0; target < data.node_count; ++target)
            for (int i = 0; i < 10; ++i) {
                // From somewhere to some corner of the target's own box, or nearly.
                Ray world{random.in_cube(12.0f), {}};
                const Node parent = detail::node_at<Node>(data, steps[target].parent);
                float at[3];
                for (int k = 0; k < 3; ++k) {
                    const std::int32_t low = parent.low(k, steps[target].child, data.bits);
                    const std::int32_t high = parent.high(k, steps[target].child, data.bits);
                    const std::int32_t place = (random.coin() ? low : high) + random.between(-1, 1);
                    at[k] = data.origin[k] + std::ldexp(static_cast<float>(place), data.step_exponent);
                }
                world.direction = {at[0] - world.origin.x, at[1] - world.origin.y, at[2] - world.origin.z};
                detail::IntegerRay ray;
                float reach = 0.0f;
                if (!detail::round_ray(data, world, ray, reach)) continue;
                constexpr std::int32_t zero[3] = {0, 0, 0};
                bool expected = passes_exactly(ray, zero, data.extent);
                for (std::uint32_t below = target; below != 0; below = steps[below].parent)
                    expected = expected && passes_exactly(ray, detail::node_at<Node>(data, steps[below].parent),
                                                          data.bits, steps[below].child);
                (expected ? passed : missed) += 1;
                CHECK(detail::passes_down_to(ray, data, detail::node_at<Node>(data, target)) == expected);
            }
    });
    CHECK(passed > 500);
    CHECK(missed > 500);
}

TEST_CASE("approximate: an accuracy is rounded down to whole steps") {
    detail::BlobData asset;
    asset.bits = 12;
    asset.step_exponent = -3;
    asset.derive();
    const std::pair<float, std::int32_t> cases[] = {
        {-1.0f, -1},
        {0.0f, -1},
        {not_a_number, -1},
        {std::numeric_limits<float>::denorm_min(), 0},
        {0.124f, 0},
        {0.125f, 1},
        {std::nextafter(0.25f, 0.0f), 1},
        {0x1p23f - 1.0f, (1 << 26) - 8},
        {std::nextafter(0x1p23f, 0.0f), (1 << 26) - 4},
        {0x1p23f, 1 << 26},
        {0x1p24f, 1 << 26},
        {infinity, 1 << 26},
    };
    for (const auto& expected : cases) {
        CAPTURE(expected.first);
        CHECK(detail::steps_in(asset, expected.first) == expected.second);
    }
}

TEST_CASE("approximate: the farthest point of a box is its farthest corner") {
    for_each_full_node([]<class Boxes>() {
        for_each_ray<Boxes>(
            50, true, [](const detail::BlobData& asset, const Boxes& boxes, const detail::IntegerRay&, Random& random) {
                detail::RoundedPoint point{};
                for (int k = 0; k < 3; ++k)
                    point.steps[k] = static_cast<float>(random.between(-100, asset.extent[k] + 100));
                const unsigned child = random.below(Boxes::children);
                double farthest = 0.0;
                for (unsigned corner = 0; corner < 8; ++corner) {
                    double sum = 0.0;
                    for (int k = 0; k < 3; ++k) {
                        const bool is_high = (corner >> k & 1u) != 0;
                        const std::int32_t steps =
                            is_high ? boxes.node.high(k, child, asset.bits) : boxes.node.low(k, child, asset.bits);
                        const double off = steps - static_cast<double>(point.steps[k]);
                        sum += off * off;
                    }
                    farthest = std::max(farthest, sum);
                }
                const double answer = double(detail::farthest_squared(boxes.node, asset.bits, child, point));
                CHECK(std::abs(answer - farthest) <= farthest * 5 * 0x1p-24);
            });
    });
}

}  // namespace
}  // namespace espalier::tests::small_boxes_test
