// Claims about where a triangle came from and what it is made of.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <espalier/blob.hpp>
#include <espalier/walk.hpp>

#include "../support/mesh_makers.hpp"
#include "../support/test_blobs.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

struct Scene {
    std::vector<Mesh> meshes;
    OpenedBlob opened;
    DecodedBlob decoded;
};

/// Several meshes of two files, an empty one among them, with a degenerate triangle so that ids and indices differ.
Scene make_scene(bool ids, Materials materials) {
    std::vector<Mesh> meshes = {make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), Mesh{}, make_torus(16, 8, 4.0, 0.5),
                                make_cube(5.0f, 6.0f)};
    meshes[0].triangles.insert(meshes[0].triangles.begin(), {3, 3, 3});
    std::uint32_t number = 0;
    std::vector<MeshView> views;
    for (Mesh& mesh : meshes) {
        const std::uint32_t last = materials == Materials::bits_16 ? 65535 : 255;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(last - (number++ * 37) % 251);
    }
    const std::pair<std::uint32_t, std::uint32_t> places[] = {{0, 0}, {0, 1}, {3, 0}, {3, 9}};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        views.push_back(meshes[i].view());
        views.back().file = places[i].first;
        views.back().mesh = places[i].second;
    }
    BakeOptions options;
    options.original_ids = ids;
    options.materials = materials;
    auto baked = bake(views, options);
    REQUIRE_MESSAGE(baked.has_value(), baked.error().message);
    OpenedBlob opened(std::move(baked->blob));
    DecodedBlob decoded = decode(opened.bytes);
    return {std::move(meshes), std::move(opened), std::move(decoded)};
}

std::size_t mesh_of(const OriginalTriangle& original) {
    if (original.file == 0) return original.mesh == 0 ? 0 : 1;
    return original.mesh == 0 ? 2 : 3;
}

/// Collected before anything is required of them: no exception may pass through the runtime.
std::vector<Corners> every_triangle(const Blob& blob) {
    std::vector<Corners> triangles;
    CHECK(for_each_triangle(blob, [&](Triangle triangle, const Corners& corners) {
        CHECK(triangle.index == triangles.size());
        return triangles.push_back(corners), keep_going;
    }));
    return triangles;
}

bool is_near(Vec3 a, Vec3 b, float distance) {
    return std::fabs(a.x - b.x) <= distance && std::fabs(a.y - b.y) <= distance && std::fabs(a.z - b.z) <= distance;
}

}  // namespace

TEST_SUITE("identity") {
    TEST_CASE("every triangle leads back to the source triangle with the same corners and material") {
        for (const Materials materials : {Materials::bits_8, Materials::bits_16}) {
            const Scene scene = make_scene(true, materials);
            const Blob& blob = scene.opened.blob;
            REQUIRE(blob.has_original_ids());
            REQUIRE(blob.has_materials());
            std::set<std::pair<std::size_t, std::uint32_t>> seen;
            const std::vector<Corners> triangles = every_triangle(blob);
            for (std::uint32_t index = 0; index < triangles.size(); ++index) {
                const Triangle triangle{index};
                const Corners& corners = triangles[index];
                OriginalTriangle original;
                REQUIRE(original_triangle(blob, triangle, original));
                const std::size_t number = mesh_of(original);
                const Mesh& mesh = scene.meshes[number];
                REQUIRE(original.triangle < mesh.triangles.size());
                const TriangleVertices& vertices = mesh.triangles[original.triangle];
                REQUIRE(is_near(corners.a, mesh.positions[vertices[0]], blob.max_error()));
                REQUIRE(is_near(corners.b, mesh.positions[vertices[1]], blob.max_error()));
                REQUIRE(is_near(corners.c, mesh.positions[vertices[2]], blob.max_error()));
                REQUIRE(material(blob, triangle) == mesh.materials[original.triangle]);
                REQUIRE(seen.emplace(number, original.triangle).second);
            }
            CHECK(seen.size() == blob.triangle_count());
            CHECK(blob.triangle_count() == 320 + 256 + 12);
        }
    }

    TEST_CASE("a blob without ids or materials, and a triangle that does not exist, have none") {
        const Scene scene = make_scene(false, Materials::none);
        OriginalTriangle original{7, 8, 9};
        CHECK_FALSE(original_triangle(scene.opened.blob, Triangle{0}, original));
        CHECK(original == OriginalTriangle{7, 8, 9});
        CHECK(material(scene.opened.blob, Triangle{0}) == 0);
        CHECK_FALSE(scene.opened.blob.has_original_ids());
        CHECK_FALSE(scene.opened.blob.has_materials());

        const Scene with_ids = make_scene(true, Materials::bits_16);
        const std::uint32_t count = with_ids.opened.blob.triangle_count();
        CHECK_FALSE(original_triangle(with_ids.opened.blob, Triangle{count}, original));
        CHECK_FALSE(original_triangle(with_ids.opened.blob, Triangle{0xFFFFFFFFu}, original));
        CHECK(original == OriginalTriangle{7, 8, 9});
        CHECK(material(with_ids.opened.blob, Triangle{count}) == 0);
        CHECK_FALSE(original_triangle(Blob(), Triangle{0}, original));
        CHECK(material(Blob(), Triangle{0}) == 0);
    }

    TEST_CASE("optional sections change nothing but themselves: the same triangles in the same order") {
        const Scene plain = make_scene(false, Materials::none);
        const Scene full = make_scene(true, Materials::bits_8);
        CHECK(plain.decoded.triangles == full.decoded.triangles);
        CHECK(plain.opened.bytes.size() < full.opened.bytes.size());
    }
}

TEST_SUITE("walking") {
    TEST_CASE("the walk sees every triangle in storage order with the corners that the decoder finds") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            const double step = std::ldexp(1.0, blob.decoded.step_exponent);
            const std::vector<Corners> triangles = every_triangle(blob.opened.blob);
            REQUIRE(triangles.size() == blob.decoded.triangles.size());
            for (std::size_t i = 0; i < triangles.size(); ++i) {
                const GridTriangle& expected = blob.decoded.triangles[i];
                const auto check = [&](Vec3 corner, const GridPoint& grid) {
                    const float given[3] = {corner.x, corner.y, corner.z};
                    for (unsigned k = 0; k < 3; ++k) {
                        const double exact = static_cast<double>(blob.decoded.origin[k]) + grid[k] * step;
                        REQUIRE(given[k] == static_cast<float>(exact));
                    }
                };
                check(triangles[i].a, expected.a);
                check(triangles[i].b, expected.b);
                check(triangles[i].c, expected.c);
            }
            int calls = 0;
            CHECK_FALSE(for_each_triangle(blob.opened.blob, [&](Triangle, const Corners&) { return ++calls, stop; }));
            CHECK(calls == 1);
        }
    }

    TEST_CASE("what the blob says about itself is what the header holds") {
        for (const TestBlob& blob : small_test_blobs()) {
            CAPTURE(blob.name);
            const Blob& view = blob.opened.blob;
            CHECK(view.triangle_count() == blob.decoded.triangle_count);
            CHECK(view.vertex_count() == distinct_corners(blob.decoded).size());
            CHECK(view.size_bytes() == blob.opened.bytes.size());
            CHECK(view.bits() == blob.decoded.bits);
            CHECK(view.depth() == blob.decoded.depth);
            CHECK(view.step() == std::ldexp(1.0f, blob.decoded.step_exponent));
            CHECK(view.max_error() == blob.decoded.max_error);
            CHECK(view.bounds_min() == Vec3{blob.decoded.origin[0], blob.decoded.origin[1], blob.decoded.origin[2]});
            unsigned deepest = 0;
            for (const DecodedNode& node : blob.decoded.nodes) deepest = std::max(deepest, node.depth);
            CHECK(view.depth() == deepest);
        }
        const Blob empty;
        CHECK(empty.triangle_count() == 0);
        CHECK(empty.bounds_min() == Vec3{});
        CHECK(empty.bounds_max() == Vec3{});
        CHECK(for_each_triangle(empty, [](Triangle, const Corners&) { return stop; }));
    }
}
