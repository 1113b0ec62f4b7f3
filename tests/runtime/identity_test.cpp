// Claims about where a triangle came from and what it is made of.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>
#include <espalier/walk.hpp>

#include "../support/guarded_pages.hpp"
#include "../support/mesh_makers.hpp"
#include "../support/profiles.hpp"
#include "../support/query_maker.hpp"
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
Scene make_scene(format::Profile profile, bool ids, Materials materials) {
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
    BakeOptions options = with_profile(profile);
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
    TEST_CASE("source triangle: every triangle leads to the source triangle with its corners and material") {
        for_each_profile([](format::Profile profile) {
            for (const Materials materials : {Materials::bits_8, Materials::bits_16}) {
                const Scene scene = make_scene(profile, true, materials);
                const Blob& blob = scene.opened.blob;
                REQUIRE(blob.has_original_ids());
                REQUIRE(blob.has_materials());
                std::set<std::pair<std::size_t, std::uint32_t>> seen;
                std::size_t turned = 0;
                const std::vector<Corners> triangles = every_triangle(blob);
                for (std::uint32_t index = 0; index < triangles.size(); ++index) {
                    const Triangle triangle{index};
                    const Corners& corners = triangles[index];
                    OriginalTriangle original;
                    REQUIRE(original_triangle(blob, triangle, original));
                    const std::size_t number = mesh_of(original);
                    const Mesh& mesh = scene.meshes[number];
                    REQUIRE(original.triangle < mesh.triangles.size());
                    REQUIRE(original.first_corner < 3);
                    turned += original.first_corner != 0 ? 1 : 0;
                    const TriangleVertices& vertices = mesh.triangles[original.triangle];
                    const auto source = [&](std::uint32_t corner) {
                        return mesh.positions[vertices[(original.first_corner + corner) % 3]];
                    };
                    REQUIRE(is_near(corners.a, source(0), blob.max_error()));
                    REQUIRE(is_near(corners.b, source(1), blob.max_error()));
                    REQUIRE(is_near(corners.c, source(2), blob.max_error()));
                    REQUIRE(material(blob, triangle) == mesh.materials[original.triangle]);
                    REQUIRE(seen.emplace(number, original.triangle).second);
                }
                CHECK(seen.size() == blob.triangle_count());
                CHECK(blob.triangle_count() == 320 + 256 + 12);
                CHECK((turned > 0) == (profile != format::Profile::fast));
            }
        });
    }

    TEST_CASE("source triangle: first_corner turns u and v into weights of the source corners") {
        for_each_profile([](format::Profile profile) {
            Mesh mesh = make_terrain(12, 3);
            std::size_t number = 0;
            for (TriangleVertices& triangle : mesh.triangles) {
                std::rotate(triangle.begin(), triangle.begin() + number++ % 3, triangle.end());
            }
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            const OpenedBlob opened(mesh, options);
            const DecodedBlob decoded = decode(opened.bytes);
            QueryMaker maker(decoded, 77);
            std::array<int, 3> seen{};
            for (int i = 0; i < 500; ++i) {
                const Ray ray = maker.ray(RayKind::incoherent);
                RayHit hit;
                OriginalTriangle original;
                if (!raycast(opened.blob, ray, hit) || !original_triangle(opened.blob, hit.triangle, original))
                    continue;
                ++seen[original.first_corner];
                float u = hit.u, v = hit.v;
                if (original.first_corner == 1) {
                    u = 1.0f - hit.u - hit.v;
                    v = hit.u;
                } else if (original.first_corner == 2) {
                    u = hit.v;
                    v = 1.0f - hit.u - hit.v;
                }
                const TriangleVertices& vertices = mesh.triangles[original.triangle];
                const Vec3 a = mesh.positions[vertices[0]], b = mesh.positions[vertices[1]],
                           c = mesh.positions[vertices[2]];
                const auto weighed = [&](float from, float second, float third) {
                    return from + u * (second - from) + v * (third - from);
                };
                const Vec3 on_source{weighed(a.x, b.x, c.x), weighed(a.y, b.y, c.y), weighed(a.z, b.z, c.z)};
                const Vec3 on_ray{ray.origin.x + hit.t * ray.direction.x, ray.origin.y + hit.t * ray.direction.y,
                                  ray.origin.z + hit.t * ray.direction.z};
                REQUIRE(is_near(on_source, on_ray, 0.01f));
            }
            CHECK(seen[0] > 0);
            CHECK((seen[1] > 0) == (profile != format::Profile::fast));
            CHECK((seen[2] > 0) == (profile != format::Profile::fast));
        });
    }

    TEST_CASE("source triangle: ids of every width lead back with and without a first corner") {
        for_each_profile([](format::Profile profile) {
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            for (const unsigned side : {1u, 2u, 3u, 5u, 9u, 17u, 40u}) {
                Mesh mesh = make_plane_grid(side);
                if (side == 1) mesh.triangles.pop_back();  // ids of no bits
                const OpenedBlob opened(mesh, options);
                const DecodedBlob decoded = decode(opened.bytes);
                std::set<std::uint32_t> seen;
                for (std::uint32_t i = 0; i < opened.blob.triangle_count(); ++i) {
                    OriginalTriangle original;
                    REQUIRE(original_triangle(opened.blob, Triangle{i}, original));
                    REQUIRE(original == OriginalTriangle{0, 0, decoded.original_ids[i], decoded.first_corners[i]});
                    seen.insert(original.triangle);
                }
                CHECK(seen.size() == mesh.triangles.size());
            }
        });
    }

    TEST_CASE("source triangle: the last id is read within the blob") {
        for_each_profile([](format::Profile profile) {
            BakeOptions options = with_profile(profile);
            options.original_ids = true;
            const auto bytes = bake_or_throw(make_plane_grid(4), options);  // 32 ids of 5 bits: nothing pads them
            const DecodedBlob decoded = decode(bytes);
            const GuardedPages pages(bytes, true);
            Blob blob;
            REQUIRE(open(pages.bytes(), blob) == Status::ok);
            REQUIRE(blob.triangle_count() == 32);
            OriginalTriangle original;
            REQUIRE(original_triangle(blob, Triangle{31}, original));
            CHECK(original == OriginalTriangle{0, 0, decoded.original_ids[31], decoded.first_corners[31]});
        });
    }

    TEST_CASE("source triangle: absent ids and materials and triangles out of range give none") {
        for_each_profile([](format::Profile profile) {
            const Scene scene = make_scene(profile, false, Materials::none);
            const OriginalTriangle before{7, 8, 9, 10};
            OriginalTriangle original = before;
            CHECK_FALSE(original_triangle(scene.opened.blob, Triangle{0}, original));
            CHECK(original == before);
            CHECK(material(scene.opened.blob, Triangle{0}) == 0);
            CHECK_FALSE(scene.opened.blob.has_original_ids());
            CHECK_FALSE(scene.opened.blob.has_materials());

            const Scene with_ids = make_scene(profile, true, Materials::bits_16);
            const std::uint32_t count = with_ids.opened.blob.triangle_count();
            CHECK_FALSE(original_triangle(with_ids.opened.blob, Triangle{count}, original));
            CHECK_FALSE(original_triangle(with_ids.opened.blob, Triangle{0xFFFFFFFFu}, original));
            CHECK(original == before);
            CHECK(material(with_ids.opened.blob, Triangle{count}) == 0);
            CHECK_FALSE(original_triangle(Blob(), Triangle{0}, original));
            CHECK(material(Blob(), Triangle{0}) == 0);
        });
    }

    TEST_CASE("source triangle: optional sections keep the triangles and their order") {
        for_each_profile([](format::Profile profile) {
            const Scene plain = make_scene(profile, false, Materials::none);
            const Scene full = make_scene(profile, true, Materials::bits_8);
            CHECK(plain.decoded.triangles == full.decoded.triangles);
            CHECK(plain.opened.bytes.size() < full.opened.bytes.size());
        });
    }
}

TEST_SUITE("identity") {
    TEST_CASE("walk: every triangle comes in storage order with the corners of the decoder") {
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

    TEST_CASE("open: the properties of a blob equal its header") {
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
