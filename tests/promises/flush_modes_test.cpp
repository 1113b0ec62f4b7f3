// The same bits with subnormal numbers flushed or not: code that shares a thread with a game engine must not change
// answers.
#include "support/testing.hpp"

#include <runtime/kernels/moving_shapes.hpp>
#include <runtime/kernels/segment_triangle.hpp>

#include "support/base/answer_hash.hpp"
#include "support/blobs/deformed_mesh.hpp"
#include "support/exercise/exercise.hpp"
#include "support/machine/float_mode.hpp"
#include "support/meshes/motions.hpp"

namespace espalier::tests::flush_modes_test {
namespace {

#if defined(__SSE2__)

/// Returns a hash of every answer's bits.
std::uint64_t ask(std::span<const std::byte> bytes, const Ray& ray, const Sphere& sphere) {
    AnswerHash answers;
    const auto add = [&](const RayHit& hit) {
        answers.add(hit.t, hit.u, hit.v, hit.normal, hit.triangle.index, static_cast<std::uint32_t>(hit.status),
                    static_cast<std::uint32_t>(hit.side), std::uint32_t{hit.reserved[0]},
                    std::uint32_t{hit.reserved[1]});
    };
    const Blob blob = open(bytes);
    answers.add(static_cast<std::uint32_t>(blob.status()));
    add(raycast(blob, ray));
    const ClosestPoint nearest = closest_point(blob, sphere.center, sphere.radius);
    answers.add(nearest.triangle.index, nearest.distance, nearest.u, nearest.v, nearest.point, nearest.on_shape,
                nearest.face_normal, static_cast<std::uint32_t>(nearest.status),
                static_cast<std::uint32_t>(nearest.feature), static_cast<std::uint32_t>(nearest.side));
    answers.add(std::uint32_t{overlaps(blob, sphere).yes()});
    static_cast<void>(for_each_hit(blob, ray, add));
    (void)for_each_overlap(blob, sphere, [&](TriangleId each) { answers.add(each.index); });
    answers.add(blob.bounds().min, blob.bounds().max);
    return answers.value();
}

TEST_CASE("float mode: rays give the same bits with flush-to-zero and denormals-are-zero") {
    {
        // The modes are real: the product of two small numbers vanishes in one of them.
        volatile float small = 0x1p-70f;
        CHECK(small * small * 0x1p40f > 0.0f);
        const FloatMode mode(flush_to_zero);
        CHECK(small * small * 0x1p40f == 0.0f);
    }
    std::vector<OpenedBlob> blobs;
    blobs.emplace_back(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}));
    blobs.emplace_back(scaled_by(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), 0x1p-85f));  // a step of 2^-100
    blobs.emplace_back(scaled_by(make_soup(200, 3), 0x1p-85f));
    blobs.emplace_back(scaled_by(make_soup(200, 3), 0x1p80f));
    blobs.emplace_back(make_far_sphere());
    const BakeOptions finest = {.resolution = Resolution::bits(24)};
    blobs.emplace_back(scaled_by(make_terrain(20, 7), 0x1p-80f), finest);  // points of the surface next to 0
    blobs.emplace_back(scaled_by(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), 0x1p-85f),
                       with_profile(Profile::balanced));
    blobs.emplace_back(scaled_by(make_soup(200, 3), 0x1p80f), with_profile(Profile::small));
    blobs.emplace_back(scaled_by(make_terrain(20, 7), 0x1p-80f), with_profile(Profile::small, finest));
    for (const OpenedBlob& opened : blobs) {
        const DecodedBlob decoded = decode(opened.bytes);
        CAPTURE(decoded.step_exponent);
        QueryMaker maker(decoded, 6);
        Random random(7);
        const auto hostile = [&] { return hostile_values[random.below(hostile_values.size())]; };
        const auto subnormal = [&] {
            return std::bit_cast<float>((static_cast<std::uint32_t>(random.next()) & 0x807FFFFFu));
        };
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            Ray ray = maker.any_ray();
            Sphere sphere = maker.sphere();
            switch (random.below(8)) {
                case 0:
                    ray.direction = {hostile(), hostile(), hostile()};
                    break;
                case 1:
                    ray.direction = {subnormal(), subnormal(), subnormal()};
                    break;
                case 2:
                    ray.origin = {subnormal(), subnormal(), subnormal()};
                    sphere.center = ray.origin;
                    break;
                case 3:
                    ray.t_min = subnormal();
                    break;
                case 4:
                    ray.t_max = hostile();
                    break;
                case 5:
                    sphere.radius = subnormal();
                    break;
                default:
                    break;
            }
            const std::uint64_t expected = ask(opened.bytes, ray, sphere);
            for (const unsigned flags : {flush_to_zero, denormals_are_zero, flush_to_zero | denormals_are_zero}) {
                const std::uint64_t actual = [&] {
                    const FloatMode mode(flags);
                    return ask(opened.bytes, ray, sphere);
                }();
                REQUIRE_MESSAGE(actual == expected, describe(ray), "; ", describe(sphere));
            }
        }
    }
}

TEST_CASE("float mode: every query gives the same bits in every mode") {
    std::vector<OpenedBlob> blobs;
    const BakeOptions finest = {.resolution = Resolution::bits(24)};
    for (const Profile profile : every_profile) {
        for (const float scale : {1.0f, 0x1p-85f, 0x1p-60f, 0x1p80f}) {
            blobs.emplace_back(scaled_by(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), scale), with_profile(profile));
            blobs.emplace_back(scaled_by(make_soup(100, 3), scale), with_profile(profile));
        }
        blobs.emplace_back(scaled_by(make_terrain(12, 7), 0x1p-80f), with_profile(profile, finest));
        const BakeOptions every_section = with_every_section(profile);
        for (const float scale : {1.0f, 0x1p-85f})
            blobs.emplace_back(scaled_by(make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), scale), every_section);
    }
    blobs.emplace_back(scaled_by(make_soup(100, 3), 0x1p-85f), with_copies());
    REQUIRE(blobs.back().blob.duplicate_reference_count() > 0);
    for (const OpenedBlob& opened : blobs) {
        CAPTURE(opened.blob.lattice().step_exponent);
        for (std::uint64_t seed = 0; seed < scaled(2); ++seed) {
            const auto answers = [&] {
                Random random(seed);
                return exercise(opened.blob, random, 20);
            };
            const std::uint64_t expected = answers();
            for (const unsigned flags : float_modes) {
                CAPTURE(flags);
                const FloatMode mode(flags);
                REQUIRE(answers() == expected);
            }
        }
    }
}

TEST_CASE("float mode: a refit gives the same bytes in every mode") {
    for (const float scale : {1.0f, 0x1p-85f, 0x1p-60f, 0x1p80f}) {
        for (const unsigned bits : {16u, 24u}) {
            CAPTURE(scale);
            CAPTURE(bits);
            const Mesh torus = scaled_by(make_torus(10, 6, 2.0, 0.75), scale);  // around 0
            BakeOptions options = deformable_options(torus, bits);
            if (scale == 0x1p-85f) options.resolution = Resolution::step(-100);
            DeformedMesh mesh(torus, options);
            Random random(bits);
            for (std::vector<Vec3> pose : every_pose(mesh.mesh)) {
                for (int i = 0; i < 20; ++i) {
                    const std::uint32_t word = random.below(1u << 24) | (random.coin() ? 0x80000000u : 0u);
                    pose[random.below(static_cast<std::uint32_t>(pose.size()))].y = std::bit_cast<float>(word);
                }
                const float quality = mesh.move_to(pose);
                const std::vector<std::byte> expected = mesh.sealed();
                for (const unsigned flags : float_modes) {
                    CAPTURE(flags);
                    mesh.move_to(mesh.mesh.positions);
                    RefitResult result;
                    {
                        const FloatMode mode(flags);
                        result = refit(mesh.deformable, pose);
                    }
                    REQUIRE(result);
                    CHECK(std::bit_cast<std::uint32_t>(result.quality) == std::bit_cast<std::uint32_t>(quality));
                    REQUIRE(mesh.sealed() == expected);
                }
            }
        }
    }
}

TEST_CASE("float mode: a ray from a hair outside a 24-bit asset gives the same hit") {
    Mesh mesh;
    const float size = 16777215.0f;
    mesh.positions = {{0, 0, 0}, {0, size, 0}, {0, 0, size}, {size, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
    const OpenedBlob blob(mesh, {.resolution = Resolution::bits(24)});
    const Ray ray{{-0x1p-104f, 100.0f, 100.0f}, {1.0f, 0.0f, 0.0f}};
    const RayHit plain = raycast(blob.blob, ray);
    REQUIRE(plain);
    RayHit flushed;
    {
        const FloatMode mode(0x8040);
        flushed = raycast(blob.blob, ray);
    }
    CHECK(same_bits(plain, flushed));
}

TEST_CASE("float mode: a box with subnormal sides is flat to every query") {
    const OpenedBlob cube(make_cube(0.0f, 16.0f));
    const Box box{{0x1p-149f, 1.0f, 1.0f}, {0.0f, 2.0f, 2.0f}};  // min.x is above max.x, but both are zero
    for (const unsigned flags : {0u, 0x8040u}) {
        CAPTURE(flags);
        const FloatMode mode(flags);
        CHECK(overlaps(cube.blob, box).yes());
        CHECK(overlaps(cube.blob, box, Accuracy{0.0f}).yes());
        CHECK(closest_point(cube.blob, box, 1.0f));
        CHECK(sweep(cube.blob, box, {1.0f, 0.0f, 0.0f}));
        CHECK(sweep(cube.blob, box, {1.0f, 0.0f, 0.0f}, [](TriangleId) { return true; }));
    }
}

TEST_CASE("float mode: a point that moves across a long side between two ticks is found") {
    // The path crosses the first side at a third of its way: the tick before is 2^-48 lattice steps away, and the
    // speed there a quotient of numbers that are as small.
    const detail::IntegerTriangle triangle = {
        {{-2591347, -2586889, 0}, {14184980, 14160577, 0}, {3467013, -6347440, 8388608}}};
    const detail::MovingSphere point = {{25778613, 25734265, 0}, 0};
    constexpr detail::SweepTick a_third = 5592406;
    CHECK(first_contact_tick(point, triangle, detail::whole_way) == a_third);
    const FloatMode mode(0x8040);
    CHECK(first_contact_tick(point, triangle, detail::whole_way) == a_third);
}

TEST_CASE("float mode: a segment that passes a side by a subnormal gap does not touch it") {
    // 2^30 steps long, and 2^-67.4 steps away: the square of that is subnormal.
    const detail::LatticeTriangle triangle = {{{0, 0, 0}, {9696974, 9377736, 14976601}, {1125151, 0, 0}}};
    const detail::RoundedSegment segment = {
        {{52803576937, -56540579173, -47683688657}, {-40262203119, 43493936486, 36817496848}, 6}, {}, {}};
    for (const unsigned flags : {0u, 0x8040u}) {
        CAPTURE(flags);
        const FloatMode mode(flags);
        const detail::SegmentDistance distance = distance_to(segment, triangle);
        CHECK(distance.squared == 0x1p-126f);
        CHECK_FALSE(is_within_radius(segment, triangle, distance, 0.0f));
        CHECK_FALSE(is_within_radius(segment, triangle, distance, 0x1p-68f));
        CHECK(is_within_radius(segment, triangle, distance, 0x1p-67f));
    }
}

TEST_CASE("float mode: a closest point with a subnormal coordinate is the same") {
    // The finest step, 2^-100, and a foot on the first side that is 2^-30 steps away from x = 0.
    Mesh mesh = {.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 4095.0f, 0.0f}, {0.0f, 2000.0f, 4000.0f}},
                 .triangles = {{0, 1, 2}}};
    const OpenedBlob opened(scaled_by(mesh, 0x1p-100f), {.resolution = Resolution::bits(12)});
    REQUIRE(opened.blob.lattice().step_exponent == -100);
    const Vec3 point{4095.015625f * 0x1p-100f, -0x1p-100f, -10.0f * 0x1p-100f};
    const ClosestPoint expected = closest_point(opened.blob, point, 1.0f);
    REQUIRE(expected);
    for (const unsigned flags : {0x8000u, 0x0040u, 0x8040u}) {
        ClosestPoint nearest;
        {
            const FloatMode mode(flags);
            nearest = closest_point(opened.blob, point, 1.0f);
        }
        CHECK(same_bits(nearest, expected));
    }
}
#endif

}  // namespace
}  // namespace espalier::tests::flush_modes_test
