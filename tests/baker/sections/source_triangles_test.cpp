// Claims about the optional sections and the closed flag.
#include "support/testing.hpp"

#include "baker/baking_support.hpp"

namespace espalier::tests::source_triangles_test {
namespace {

TEST_CASE("source triangle: ids lead to file and mesh and triangle whatever was dropped") {
    for_each_profile([](Profile profile) {
        Mesh first = make_cube(0.0f, 1.0f);
        first.triangles.insert(first.triangles.begin(), {0, 0, 1});
        const Mesh empty;
        Mesh second = make_icosphere(2, 0.25, {3, 0, 0});
        second.triangles[5] = second.triangles[4];
        std::vector<MeshView> views = {first.view(), empty.view(), second.view()};
        views[0].file = 7;
        views[0].mesh = 1;
        views[2].file = 9;
        views[2].mesh = 2;
        const auto result = bake(views, {.profile = profile, .original_ids = true});
        REQUIRE(result);
        const OpenedBlob opened(result.bytes);
        CHECK(opened.blob.has_original_ids());
        const DecodedBlob decoded = decode(result.bytes);
        REQUIRE(decoded.sources.size() == 3);
        CHECK(decoded.sources[1].first == 13);
        CHECK(decoded.sources[2].first == 13);
        CHECK(decoded.source_triangles == 13 + second.triangles.size());
        for (std::uint32_t i = 0; i < opened.blob.triangle_count(); ++i) {
            const Result<OriginalTriangle> original = original_triangle(opened.blob, TriangleId{i});
            REQUIRE(original);
            const Mesh& mesh = original->file == 7 ? first : second;
            CHECK(original->mesh == (original->file == 7 ? 1 : 2));
            REQUIRE(original->triangle < mesh.triangles.size());
            require_near_source(decoded, i, mesh, original->triangle, original->first_corner);
        }
    });
}

TEST_CASE("source triangle: a blob without ids has the same tree") {
    for_each_profile([](Profile profile) {
        Mesh mesh = make_terrain(10, 1);
        BakeOptions options = with_profile(profile);
        const auto without = must_bake_mesh(mesh, options);
        options.original_ids = true;
        mesh.materials.assign(mesh.triangles.size(), 1);
        const auto with = must_bake_mesh(mesh, options);
        CHECK(!OpenedBlob(without.bytes).blob.has_original_ids());
        const std::size_t tree_end = without.bytes.size();
        CHECK(with.bytes.size() > tree_end);
        CHECK(std::equal(without.bytes.begin() + format::header::bytes, without.bytes.end(),
                         with.bytes.begin() + format::header::bytes));
    });
}

TEST_CASE("source triangle: ids take half of one width in scan order and hardly more in random order") {
    for_each_profile([](Profile profile) {
        BakeOptions with = with_profile(profile), without = with;
        with.original_ids = true;
        const auto share = [&](const Mesh& mesh) {
            const std::size_t bytes = bake_or_throw(mesh, with).size() - bake_or_throw(mesh, without).size();
            const unsigned width =
                static_cast<unsigned>(std::bit_width(mesh.triangles.size() - 1)) + (profile == Profile::fast ? 0 : 2);
            return 8.0 * static_cast<double>(bytes) / (width * static_cast<double>(mesh.triangles.size()));
        };
        Mesh mesh = make_terrain(100, 1);
        CHECK(share(mesh) < 0.5);
        Random random(1);
        for (std::size_t i = mesh.triangles.size(); i > 1; --i)
            std::swap(mesh.triangles[i - 1], mesh.triangles[random.below(static_cast<std::uint32_t>(i))]);
        CHECK(share(mesh) < 1.05);
    });
}

TEST_CASE("source triangle: materials follow their triangles in 8 and 16 bits and default to 0") {
    for_each_profile([](Profile profile) {
        Mesh mesh = make_icosphere(3, 1.0, {0, 0, 0});
        for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(i * 7 % 256);
        const Mesh plain = make_cube(3.0f, 4.0f);
        for (const unsigned bits : {8u, 16u}) {
            if (bits == 16) mesh.materials[3] = 65535;
            const auto result = must_bake_meshes({&mesh, &plain}, {.profile = profile, .original_ids = true});
            const OpenedBlob opened(result.bytes);
            CHECK(opened.blob.has_materials());
            const DecodedBlob decoded = decode(result.bytes);
            for (std::uint32_t i = 0; i < opened.blob.triangle_count(); ++i) {
                const std::uint32_t id = decoded.original_ids[i];
                CHECK(material(opened.blob, TriangleId{i}) == (id < mesh.materials.size() ? mesh.materials[id] : 0));
            }
        }
    });
}

TEST_CASE("source triangle: ids and materials of one triangle and of none are valid") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = {.profile = profile, .original_ids = true};
        Mesh cube = make_cube(0.0f, 1.0f);
        cube.materials.assign(cube.triangles.size(), 300);
        for (const std::size_t count : {0u, 1u, 2u, 3u}) {
            CHECK(OpenedBlob(first_triangles(cube, count), options).blob.triangle_count() == count);
        }
        CHECK(OpenedBlob(bake({}, options).bytes).blob.triangle_count() == 0);
    });
}

TEST_CASE("closed: closed meshes are and fewer or more or reversed triangles make them open") {
    for (const Mesh& mesh : {make_cube(0.0f, 1.0f), make_icosphere(3, 1.0, {0, 0, 0}), make_torus(20, 12, 3.0, 1.0)}) {
        const auto is_closed = [](const Mesh& candidate) { return must_bake_mesh(candidate).report.closed; };
        CHECK(is_closed(mesh));
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 7) {
            Mesh less = mesh;
            less.triangles.erase(less.triangles.begin() + static_cast<std::ptrdiff_t>(i));
            CHECK(!is_closed(less));
            Mesh turned = mesh;
            std::swap(turned.triangles[i][0], turned.triangles[i][1]);
            CHECK(!is_closed(turned));
            Mesh more = mesh;
            more.triangles.push_back({more.triangles[i][1], more.triangles[i][0], more.triangles[i][2]});
            CHECK(!is_closed(more));
        }
    }
}

TEST_CASE("closed: two closed meshes that share an edge are closed") {
    Mesh mesh = make_cube(0.0f, 1.0f);
    Mesh other = make_cube(0.0f, 1.0f);
    for (Vec3& point : other.positions) point = {point.x + 1.0f, point.y + 1.0f, point.z};
    append(mesh, other);
    CHECK(bake_mesh(mesh).report.closed);
    for (std::size_t i = 8; i < 16; ++i) mesh.positions[i].x += 1.0f;
    CHECK(bake_mesh(mesh).report.closed);
}

TEST_CASE("closed: an open mesh and an empty one are not") {
    CHECK(!bake_mesh(make_terrain(5, 1)).report.closed);
    CHECK(!bake({}, {}).report.closed);
}

}  // namespace
}  // namespace espalier::tests::source_triangles_test
