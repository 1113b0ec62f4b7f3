// Claims about the ray queries as the header words them; every_hit_test.cpp compares them with exact arithmetic.
#include "support/testing.hpp"

#include <espalier/advanced/statistics.hpp>

#include "support/exact/as_rationals.hpp"
#include "support/machine/instruction_paths.hpp"

namespace espalier::tests::ray_test {
namespace {

TEST_CASE("ray: closest hit on a cube matches hand-computed values") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    RayHit hit = raycast(cube.blob, {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -2.0f}});
    CHECK(hit.t == 2.0f);
    CHECK(hit.normal == Vec3{0.0f, 0.0f, 1.0f});
    CHECK(hit.side == Side::front);
    hit = raycast(cube.blob, {{0.25f, 0.5f, 0.0f}, {1.0f, 0.0f, 0.0f}});
    CHECK(hit.t == 0.75f);
    CHECK(hit.normal == Vec3{1.0f, 0.0f, 0.0f});
    CHECK(hit.side == Side::back);
    CHECK_FALSE(raycast(cube.blob, {{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, 1.0f}}));
}

TEST_CASE("ray: the front is seen from outside and the back from inside") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    Ray ray{{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -1.0f}};
    RayHit hit;
    ray.culling = FaceCulling::back;
    hit = raycast(cube.blob, ray);
    CHECK(hit.t == 4.0f);
    ray.culling = FaceCulling::front;
    hit = raycast(cube.blob, ray);
    CHECK(hit.t == 6.0f);
    CHECK(hit.normal == Vec3{0.0f, 0.0f, -1.0f});
    ray.origin.z = 0.0f;
    ray.culling = FaceCulling::back;
    CHECK_FALSE(raycast(cube.blob, ray));
    ray.culling = FaceCulling::none;
    CHECK(raycast(cube.blob, ray));
}

TEST_CASE("ray: the window is closed at both ends and may be infinite") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    Ray ray{{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -1.0f}};
    RayHit hit;
    ray.t_max = 4.0f;
    CHECK(raycast(cube.blob, ray));
    ray.t_max = std::nextafter(4.0f, 0.0f);
    CHECK_FALSE(raycast(cube.blob, ray));
    ray.t_min = 4.0f;
    ray.t_max = infinity;
    hit = raycast(cube.blob, ray);
    CHECK(hit.t == 4.0f);
    ray.t_min = std::nextafter(4.0f, 5.0f);
    hit = raycast(cube.blob, ray);
    CHECK(hit.t == 6.0f);
    ray.t_min = -infinity;
    ray.t_max = 0.0f;
    CHECK_FALSE(raycast(cube.blob, ray));
    ray.origin.z = 1.0f;
    hit = raycast(cube.blob, ray);
    CHECK(hit);
    CHECK(hit.t == 0.0f);
}

TEST_CASE("ray: a window that ends at -0 holds a hit at its origin") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    Ray ray{{0.25f, 0.5f, 1.0f}, {0.0f, 0.0f, -1.0f}};
    for (const float begin : {0.0f, -0.0f}) {
        ray.t_min = begin;
        ray.t_max = -0.0f;
        const RoundedRay rounded = round_ray(cube.blob.lattice(), ray);
        for (const InstructionPath& path : instruction_paths()) {
            CAPTURE(path.name);
            RayHit hit = path.closest_hit(detail::data_of(cube.blob), ray, {});
            CHECK(hit.t == 0.0f);
            CHECK(path.any_hit(detail::data_of(cube.blob), ray, {}).yes());
            YesNo occluded;
            path.any_hits(detail::data_of(cube.blob), &ray, &occluded, 1);
            CHECK(occluded.yes());
            hit = {};
            path.closest_hits(detail::data_of(cube.blob), &ray, &hit, 1);
            CHECK(hit);
        }
        const RayHit hit = raycast(cube.blob, rounded);
        CHECK(hit.t == 0.0f);
    }
}

TEST_CASE("ray: a reported t is inside the window after rounding") {
    std::uint64_t at_the_end = 0;
    ask_each<QueryMaker>(small_test_blobs(), 475, scaled_share(1'000),
                         [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
                             Ray ray = maker.any_ray();
                             RayHit hit = raycast(blob.opened.blob, ray);
                             if (!hit) return;
                             const float t = hit.t;
                             // The exact t lies between two of these floats: as ends of the window they cut off the
                             // rounding.
                             for (const float bound : {std::nextafter(std::nextafter(t, 0.0f), 0.0f),
                                                       std::nextafter(t, 0.0f), t, std::nextafter(t, infinity)}) {
                                 CAPTURE(describe(ray));
                                 ray.t_min = 0.0f;
                                 ray.t_max = bound;
                                 hit = raycast(blob.opened.blob, ray);
                                 if (hit) {
                                     REQUIRE(hit.t <= bound);
                                     if (hit.t == bound) ++at_the_end;
                                 }
                                 ray.t_min = bound;
                                 ray.t_max = infinity;
                                 hit = raycast(blob.opened.blob, ray);
                                 if (hit) REQUIRE(hit.t >= bound);
                             }
                         });
    CHECK(at_the_end > 0);
}

TEST_CASE("ray: a miss is no triangle at an infinite t and a refusal is neither a hit nor a no") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f)), empty(Mesh{});
    const Ray down{{0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, -1.0f}}, up{{0.0f, 0.0f, 5.0f}, {0.0f, 0.0f, 1.0f}};
    const auto none = [](TriangleId) { return false; };
    const auto check = [&](const Blob& blob, const Ray& ray, QueryStatus status) {
        const YesNo any = occluded(blob, ray);
        CHECK(any.status() == status);
        CHECK_FALSE(any.yes());
        CHECK(any.no() == (status == QueryStatus::not_found));
        RayHit hits[1];
        hits[0].t = 7.0f;
        YesNo answers[1];
        CHECK(raycast(blob, std::span(&ray, 1), hits).status == (blob ? QueryStatus::ok : QueryStatus::not_open));
        CHECK(occluded(blob, std::span(&ray, 1), answers).count == (blob ? 1 : 0));
        if (blob) CHECK(answers[0].status() == status);
        QueryCounters counters;
        for (const RayHit& hit : {raycast(blob, ray), raycast(blob, ray, none), raycast(blob, ray, counters),
                                  blob ? hits[0] : raycast(blob, ray)}) {
            CHECK_FALSE(hit);
            CHECK(hit.status == status);
            CHECK(hit.triangle == no_triangle);
            CHECK(hit.t == infinity);
            CHECK(hit.normal == Vec3{});
        }
        const QueryStatus of_lists = status == QueryStatus::not_found ? QueryStatus::ok : status;
        CHECK(closest_hits(blob, ray, hits).status == of_lists);
        CHECK(closest_hits(blob, ray, hits).count == 0);
        CHECK(for_each_hit(blob, ray, [](const RayHit&) {}) == of_lists);
        CHECK(occluded(blob, ray, Accuracy{0.5f}).status() == status);
    };
    check(cube.blob, up, QueryStatus::not_found);
    for (const Ray& ray : {up, down}) {
        check(empty.blob, ray, QueryStatus::not_found);
        check(Blob(), ray, QueryStatus::not_open);
        check(open(std::span(cube.bytes).first(100)), ray, QueryStatus::not_open);
    }
    CHECK_FALSE(raycast(cube.blob, down, none));
    CHECK(raycast(cube.blob, down, none).status == QueryStatus::not_found);
    CHECK(occluded(cube.blob, down, none).no());
    CHECK(raycast(cube.blob, down, TriangleFilter()));
    for (const Blob& blob : {cube.blob, empty.blob}) {
        for (unsigned number = 0; number < 8; ++number) {
            for (const float bad : {not_a_number, -not_a_number, infinity, -infinity}) {
                if (number >= 6 && !std::isnan(bad)) continue;  // windows may be endless
                Ray ray = down;
                *numbers_of(ray)[number] = bad;
                check(blob, ray, QueryStatus::invalid_argument);
                ray.t_min = std::isnan(ray.t_min) ? not_a_number : 2.0f;  // an empty window is no excuse
                ray.t_max = std::isnan(ray.t_max) ? not_a_number : 1.0f;
                check(blob, ray, QueryStatus::invalid_argument);
            }
        }
        Ray still = down;
        still.direction = {0.0f, -0.0f, 0.0f};
        check(blob, still, QueryStatus::invalid_argument);
        check(blob, Ray::between(down.origin, down.origin), QueryStatus::invalid_argument);
        Ray far = down;
        far.origin.y = std::numeric_limits<float>::max();
        check(blob, far, QueryStatus::out_of_range);
        far.direction.x = not_a_number;
        check(blob, far, QueryStatus::invalid_argument);
    }
    for (const float end : {-1.0f, -infinity}) {
        Ray over = down;
        over.t_max = end;
        check(cube.blob, over, QueryStatus::not_found);
    }
    Ray never = down;
    never.t_min = infinity;
    check(cube.blob, never, QueryStatus::not_found);
}

TEST_CASE("ray: the lowest storage index wins among hits of equal t") {
    // Triangles of one plane, all of them over the origin.
    Mesh mesh;
    for (unsigned i = 0; i < 100; ++i) {
        const auto reach = static_cast<float>(1 + i);
        append_triangle(mesh, {-reach, -1.0f, 0.0f}, {reach, -1.0f, 0.0f}, {0.0f, reach, 0.0f});
    }
    const OpenedBlob stack(mesh);
    REQUIRE(stack.blob.triangle_count() == 100);
    const Ray ray{{0.0f, -0.5f, 3.0f}, {0.0f, 0.0f, -1.0f}};
    RayHit hit = raycast(stack.blob, ray);
    CHECK(hit.triangle.index == 0);
    for (std::uint32_t below = 0; below < 100; below += 7) {
        hit = raycast(stack.blob, ray, [&](TriangleId triangle) { return triangle.index >= below; });
        CHECK(hit.triangle.index == below);
    }
}

TEST_CASE("ray: a visitor that stops is not called again and the status reports it") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    const Ray ray{{0.25f, 0.5f, 5.0f}, {0.0f, 0.0f, -1.0f}};
    int calls = 0;
    const auto stop = [&](const RayHit&) { return ++calls, Visit::stop; };
    CHECK(for_each_hit(cube.blob, ray, stop) == QueryStatus::stopped);
    CHECK(calls == 1);
    CHECK(for_each_hit(cube.blob, ray, [&](const RayHit&) { ++calls; }) == QueryStatus::ok);
    CHECK(calls == 3);
    CHECK(for_each_hit(Blob(), ray, stop) == QueryStatus::not_open);
    CHECK(calls == 3);
}

TEST_CASE("ray: a ray in the plane of a triangle misses it and hits its neighbours") {
    const OpenedBlob cube(make_cube(-1.0f, 1.0f));
    // Within the top face: only the sides at both ends are hit.
    const RayHit hit = raycast(cube.blob, {{-5.0f, 0.25f, 1.0f}, {1.0f, 0.0f, 0.0f}});
    CHECK(hit.t == 4.0f);
    CHECK(std::fabs(hit.normal.x) == 1.0f);
}

TEST_CASE("ray: length and scale of a direction change only t") {
    ask_each<QueryMaker>(small_test_blobs(), 500, scaled_share(200),
                         [&](const TestBlob& blob, QueryMaker& maker, std::uint64_t) {
                             const Ray ray = maker.ray(RayKind::incoherent);
                             Ray longer = ray;
                             longer.direction = times(ray.direction, 8.0f);
                             const RayHit hit = raycast(blob.opened.blob, ray);
                             RayHit longer_hit = raycast(blob.opened.blob, longer);
                             REQUIRE(longer_hit.status == hit.status);
                             if (!hit) return;
                             REQUIRE(same_bits(longer_hit.t * 8.0f, hit.t));
                             longer_hit.t = hit.t;
                             REQUIRE(same_bits(longer_hit, hit));
                         });
}

TEST_CASE("ray: a mesh scaled by a power of two gives the scaled answers") {
    const Mesh mesh = make_torus(40, 20, 2.0, 0.5);
    const OpenedBlob plain(mesh);
    const DecodedBlob decoded = decode(plain.bytes);
    for (const float scale : {0x1p20f, 0x1p-20f}) {
        const OpenedBlob scaled_blob(scaled_by(mesh, scale));
        QueryMaker maker(decoded, 600);
        for (std::uint64_t i = 0; i < scaled(2'000); ++i) {
            Ray ray = maker.any_ray();
            const RayHit hit = raycast(plain.blob, ray);
            ray.origin = times(ray.origin, scale);
            ray.direction = times(ray.direction, scale);
            REQUIRE(same_bits(raycast(scaled_blob.blob, ray), hit));
            Sphere sphere = maker.sphere();
            const ClosestPoint nearest = closest_point(plain.blob, sphere.center, sphere.radius);
            sphere.center = times(sphere.center, scale);
            const ClosestPoint scaled_nearest = closest_point(scaled_blob.blob, sphere.center, sphere.radius * scale);
            REQUIRE(scaled_nearest.status == nearest.status);
            if (nearest) {
                REQUIRE(scaled_nearest.triangle == nearest.triangle);
                REQUIRE(same_bits(scaled_nearest.distance, nearest.distance * scale));
            }
        }
    }
}

}  // namespace
}  // namespace espalier::tests::ray_test
