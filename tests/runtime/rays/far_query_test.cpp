// Queries from far away and from a hair outside: where rounding, ties and subnormal numbers meet.
#include "support/testing.hpp"

#include <cfenv>

namespace espalier::tests::far_query_test {
namespace {

/// Triangles in planes z = 0, 1, 2 .. over the same square.
Mesh stacked_triangles(unsigned count) {
    Mesh mesh;
    for (unsigned i = 0; i < count; ++i) {
        const auto z = static_cast<float>(i);
        append_triangle(mesh, {0.0f, 0.0f, z}, {64.0f, 0.0f, z}, {0.0f, 64.0f, z});
    }
    return mesh;
}

TEST_CASE("ray: the lowest index wins among far hits that round to the same t") {
    tests::for_each_profile([](Profile profile) {
        const OpenedBlob stack(stacked_triangles(40), tests::with_profile(profile));
        const Ray ray{{8.0f, 8.0f, 0x1p34f}, {0.0f, 0.0f, -1.0f}};
        const RayHit hit = raycast(stack.blob, ray);
        CHECK(hit.t == 0x1p34f);
        CHECK(hit.triangle.index == 0);
        unsigned hits = 0;
        const QueryStatus status = for_each_hit(stack.blob, ray, [&](const RayHit& each) {
            CHECK(each.t == 0x1p34f);
            ++hits;
        });
        CHECK(status == QueryStatus::ok);
        CHECK(hits == 40);
    });
}

TEST_CASE("closest point: the nearer of two corners is found from 2^32 steps away") {
    Mesh mesh;
    const float top = 16777215.0f;
    append_triangle(mesh, {0.0f, 0.0f, 0.0f}, {0.0f, 1000.0f, 0.0f}, {0.0f, 0.0f, 1000.0f});
    append_triangle(mesh, {40000.0f, top, 0.0f}, {41000.0f, top, 0.0f}, {40000.0f, top, 1000.0f});
    const OpenedBlob blob(mesh, {.resolution = Resolution::bits(24)});
    const Vec3 point{-1.5f * 0x1p32f, top, 0.0f};
    const ClosestPoint nearest = closest_point(blob.blob, point);
    CHECK(nearest.point.x == 0.0f);
    const double exact = std::hypot(1.5 * 0x1p32, static_cast<double>(top) - 1000.0);
    CHECK(std::abs(static_cast<double>(nearest.distance) - exact) < exact * 0x1p-22);
    CHECK(overlaps(blob.blob, Sphere{point, static_cast<float>(exact * (1.0 + 0x1p-21))}).yes());
}

TEST_CASE("promise: no query divides by zero") {
    const OpenedBlob stack(stacked_triangles(20));
    std::feclearexcept(FE_ALL_EXCEPT);
    CHECK(raycast(stack.blob, {{8.0f, 8.0f, 100.0f}, {0.0f, 0.0f, -1.0f}}));
    CHECK(raycast(stack.blob, {{9.0f, 8.0f, 100.0f}, {0.1f, 0.2f, -1.0f}}));
    CHECK(overlaps(stack.blob, Sphere{{8.0f, 8.0f, 1.0f}, 0.5f}).yes());
    CHECK(std::fetestexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW) == 0);
}

}  // namespace
}  // namespace espalier::tests::far_query_test
