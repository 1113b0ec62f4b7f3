// Claims about the boxes of moving instances in whole steps.
#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/steps_box.hpp>

#include "made_scene.hpp"
#include "support/machine/float_mode.hpp"

namespace espalier::tests::steps_box_test {
namespace {

using namespace espalier::detail;

constexpr std::int32_t step_exponent = -12;

TEST_CASE("scene: the box of a moving instance holds each corner in the world and little more") {
    const OpenedBlob opened(make_torus(16, 9, 2.0, 0.5));
    const PartBounds bounds = bounds_of(data_of(opened.blob));
    Random random(1);
    const double step = std::ldexp(1.0, step_exponent);
    for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
        const Transform transform = random_place(random);
        StepsBox box{};
        REQUIRE(find_steps_box(bounds, transform, step_exponent, box));
        double low[3] = {1e30, 1e30, 1e30}, high[3] = {-1e30, -1e30, -1e30};
        for (std::uint32_t t = 0; t < opened.blob.triangle_count(); ++t) {
            const Triangle corners = *triangle_at(opened.blob, {t});
            for (const Vec3& corner : {corners.a, corners.b, corners.c}) {
                const Vec3 p = to_world(transform, corner);
                const double at[3] = {double(p.x), double(p.y), double(p.z)};
                for (int k = 0; k < 3; ++k) {
                    low[k] = std::fmin(low[k], at[k]);
                    high[k] = std::fmax(high[k], at[k]);
                }
            }
        }
        for (int k = 0; k < 3; ++k) {
            CAPTURE(i);
            REQUIRE(box.low[k] * step < low[k]);
            REQUIRE(box.high[k] * step > high[k]);
            // The box of a turned box: at most sqrt(3) times as long as the torus in it, here 5 across.
            REQUIRE((box.high[k] - box.low[k]) * step <= 1.74 * 5.01 * double(transform.scale) + 4 * step + 0.02);
        }
    }
}

TEST_CASE("scene: an instance that leaves the world or has no sound place has no box") {
    const OpenedBlob opened(make_cube(-1.0f, 1.0f));
    const PartBounds bounds = bounds_of(data_of(opened.blob));
    StepsBox box{};
    const float end = std::ldexp(1.0f, 30 + step_exponent);
    for (const float x : {end - 2.0f, 2.0f - end}) {
        Transform transform;
        transform.translation.y = x;
        CHECK(find_steps_box(bounds, transform, step_exponent, box));
        transform.translation.y = x > 0.0f ? end : -end;
        CHECK_FALSE(find_steps_box(bounds, transform, step_exponent, box));
    }
    for (const float bad : {std::numeric_limits<float>::infinity(), not_a_number}) {
        Transform transform;
        transform.translation.z = bad;
        CHECK_FALSE(find_steps_box(bounds, transform, step_exponent, box));
        transform = {};
        transform.rotation.x = bad;
        CHECK_FALSE(find_steps_box(bounds, transform, step_exponent, box));
        transform = {};
        transform.scale = bad;
        CHECK_FALSE(find_steps_box(bounds, transform, step_exponent, box));
    }
    Transform transform = {{0.0f, 0.0f, 0.0f, 0.0f}, {}};
    CHECK_FALSE(find_steps_box(bounds, transform, step_exponent, box));
}

TEST_CASE("scene: boxes of moving instances have the same bits in every float mode") {
    Random random(3);
    for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
        CAPTURE(i);
        const auto any = [&](int exponent) { return std::ldexp(random.signed_unit(), -random.between(0, exponent)); };
        const int size = random.between(-100, 60), scale = random.between(-100, 40);
        const auto length = [&] { return std::ldexp(any(60), size); };
        const Vec3 center = {length(), length(), length()};
        const Vec3 half = {std::fabs(length()), std::fabs(length()), std::fabs(length())};
        const float reach = std::fabs(center.x) + half.x + std::fabs(center.y) + half.y + std::fabs(center.z) + half.z;
        const PartBounds bounds = {center, half, 0.0f, reach, 1.0f};
        const int turn = random.between(-120, 100), way = random.between(-140, 60);
        const Transform transform = {
            {std::ldexp(any(60), turn), std::ldexp(any(60), turn), std::ldexp(any(60), turn), std::ldexp(1.0f, turn)},
            {std::ldexp(any(10), way), std::ldexp(any(10), way), std::ldexp(any(10), way)},
            std::ldexp(1.0f + random.unit(), scale)};
        const int exponent = random.between(-100, 80);
        StepsBox expected{};
        const bool is_in_world = find_steps_box(bounds, transform, exponent, expected);
        for (const unsigned flags : float_modes) {
            CAPTURE(flags);
            const FloatMode mode(flags);
            StepsBox box{};
            REQUIRE(find_steps_box(bounds, transform, exponent, box) == is_in_world);
            if (is_in_world) REQUIRE(box == expected);
        }
    }
}

}  // namespace
}  // namespace espalier::tests::steps_box_test
