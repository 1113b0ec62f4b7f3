// Claims about where a triangle came from and what it is made of.
#include "support/testing.hpp"

#include "every_triangle.hpp"
#include "support/machine/guarded_pages.hpp"

namespace espalier::tests::identity_test {
namespace {

struct Scene {
    std::vector<Mesh> meshes;
    OpenedBlob opened;
    DecodedBlob decoded;
};

/// Several meshes of two files, an empty one among them, with a degenerate triangle so that ids and indices differ.
Scene make_scene(Profile profile, bool ids, unsigned material_bits) {
    std::vector<Mesh> meshes = {make_icosphere(2, 1.0, {0.0f, 0.0f, 0.0f}), Mesh{}, make_torus(16, 8, 4.0, 0.5),
                                make_cube(5.0f, 6.0f)};
    meshes[0].triangles.insert(meshes[0].triangles.begin(), {3, 3, 3});
    std::uint32_t number = 0;
    std::vector<MeshView> views;
    for (Mesh& mesh : meshes) {
        if (material_bits == 0) break;
        const std::uint32_t last = material_bits == 16 ? 65535 : 255;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) mesh.materials.push_back(last - (number++ * 37) % 251);
    }
    const std::pair<std::uint32_t, std::uint32_t> places[] = {{0, 0}, {0, 1}, {3, 0}, {3, 9}};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        views.push_back(meshes[i].view());
        views.back().file = places[i].first;
        views.back().mesh = places[i].second;
    }
    auto baked = bake(views, {.profile = profile, .original_ids = ids});
    REQUIRE_MESSAGE(baked, baked.message);
    OpenedBlob opened(std::move(baked.bytes));
    DecodedBlob decoded = decode(opened.bytes);
    return {std::move(meshes), std::move(opened), std::move(decoded)};
}

std::size_t mesh_of(const OriginalTriangle& original) {
    if (original.file == 0) return original.mesh == 0 ? 0 : 1;
    return original.mesh == 0 ? 2 : 3;
}

using Remap = std::vector<OriginalTriangle>;

Remap remap_of(const DecodedBlob& decoded) {
    Remap remap;
    for (std::size_t i = 0; i < decoded.original_ids.size(); ++i)
        remap.push_back({0, 0, decoded.original_ids[i], decoded.first_corners[i]});
    return remap;
}

bool same(const OriginalHit& a, const OriginalHit& b) {
    return a.file == b.file && a.mesh == b.mesh && a.triangle == b.triangle && a.u == b.u && a.v == b.v &&
           a.status == b.status;
}

bool is_near(Vec3 a, Vec3 b, float distance) {
    return std::fabs(a.x - b.x) <= distance && std::fabs(a.y - b.y) <= distance && std::fabs(a.z - b.z) <= distance;
}

TEST_CASE("source triangle: every triangle leads to the source triangle with its corners and material") {
    for_each_profile([](Profile profile) {
        for (const unsigned material_bits : {8u, 16u}) {
            const Scene scene = make_scene(profile, true, material_bits);
            const Blob& blob = scene.opened.blob;
            REQUIRE(blob.has_original_ids());
            REQUIRE(blob.has_materials());
            std::set<std::pair<std::size_t, std::uint32_t>> seen;
            std::size_t turned = 0;
            const std::vector<Triangle> triangles = every_triangle(blob);
            for (std::uint32_t index = 0; index < triangles.size(); ++index) {
                const TriangleId triangle{index};
                const Triangle& corners = triangles[index];
                const Result<OriginalTriangle> found = original_triangle(blob, triangle);
                REQUIRE(found);
                const OriginalTriangle& original = *found;
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
            CHECK((turned > 0) == (profile != Profile::fast));
        }
    });
}

TEST_CASE("source triangle: original_hit gives the triangle and the weights that make up the point of the hit") {
    for_each_profile([](Profile profile) {
        Mesh mesh = make_terrain(12, 3);
        std::size_t number = 0;
        for (TriangleVertices& triangle : mesh.triangles) {
            std::rotate(triangle.begin(), triangle.begin() + number++ % 3, triangle.end());
        }
        const OpenedBlob opened(mesh, {.profile = profile, .original_ids = true});
        const DecodedBlob decoded = decode(opened.bytes);
        const Remap remap = remap_of(decoded);
        QueryMaker maker(decoded, 77);
        std::array<int, 3> seen{};
        for (int i = 0; i < 500; ++i) {
            const Ray ray = maker.ray(RayKind::incoherent);
            const RayHit hit = raycast(opened.blob, ray);
            if (!hit) continue;
            const OriginalHit original = original_hit(opened.blob, hit);
            REQUIRE(original);
            REQUIRE(same(original_hit(remap, hit), original));
            ++seen[decoded.first_corners[hit.triangle.index]];
            REQUIRE(original.file == 0);
            REQUIRE(original.mesh == 0);
            REQUIRE(original.triangle == decoded.original_ids[hit.triangle.index]);
            const TriangleVertices& vertices = mesh.triangles[original.triangle];
            const Vec3 a = mesh.positions[vertices[0]], b = mesh.positions[vertices[1]],
                       c = mesh.positions[vertices[2]];
            const auto weighed = [&](float from, float second, float third) {
                return from + original.u * (second - from) + original.v * (third - from);
            };
            const Vec3 on_source{weighed(a.x, b.x, c.x), weighed(a.y, b.y, c.y), weighed(a.z, b.z, c.z)};
            const Vec3 on_ray = sum(ray.origin, times(ray.direction, hit.t));
            REQUIRE(is_near(on_source, on_ray, 0.002f));
        }
        CHECK(seen[0] > 0);
        CHECK((seen[1] > 0) == (profile != Profile::fast));
        CHECK((seen[2] > 0) == (profile != Profile::fast));
    });
}

TEST_CASE("source triangle: original_hit turns the weights as first_corner requires and none below 0") {
    Random random(5);
    float worst = 0.0f;
    for (int i = 0; i < 10000; ++i) {
        RayHit hit;
        hit.triangle = {0};
        hit.u = random.below(4) == 0 ? std::ldexp(1.0f, -static_cast<int>(random.below(40))) : random.unit();
        hit.v = random.unit() * (1.0f - hit.u);
        if (random.below(4) == 0) hit.v = std::nextafter(1.0f - hit.u, 2.0f);  // rounded over the edge
        const double rest = std::max(0.0, 1.0 - static_cast<double>(hit.u) - static_cast<double>(hit.v));
        for (const std::uint32_t first_corner : {0u, 1u, 2u}) {
            const OriginalTriangle remap[] = {{1, 2, 3, first_corner}};
            const OriginalHit original = original_hit(remap, hit);
            REQUIRE(original);
            REQUIRE(original.file == 1);
            REQUIRE(original.mesh == 2);
            REQUIRE(original.triangle == 3);
            REQUIRE(original.u >= 0.0f);
            REQUIRE(original.v >= 0.0f);
            const float first = first_corner == 1 ? original.u : first_corner == 2 ? original.v : 0.0f;
            if (first_corner == 0) REQUIRE(original.u == hit.u);
            if (first_corner != 1) REQUIRE((first_corner == 0 ? original.v : original.u) == hit.v);
            if (first_corner == 1) REQUIRE(original.v == hit.u);
            if (first_corner == 0) continue;
            worst = std::max(worst, static_cast<float>(std::fabs(static_cast<double>(first) - rest)));
        }
    }
    CHECK(worst <= std::ldexp(1.0f, -24));
    CHECK(worst > 0.0f);
}

TEST_CASE("source triangle: a batch gives what one call for each gives") {
    for_each_profile([](Profile profile) {
        const Scene scene = make_scene(profile, true, 0);
        const Blob& blob = scene.opened.blob;
        std::vector<RayHit> hits(50);
        std::vector<TriangleId> triangles;
        for (std::uint32_t i = 0; i < hits.size(); ++i) {
            hits[i].u = 0.25f;
            hits[i].triangle = {i * 11};
            triangles.push_back(hits[i].triangle);
        }
        hits[3].triangle = no_triangle;
        hits[4].triangle = {blob.triangle_count()};
        std::vector<OriginalHit> originals(hits.size());
        const Filled all_hits = original_hit(blob, hits, originals);
        REQUIRE(all_hits.status == QueryStatus::ok);
        REQUIRE(all_hits.count == hits.size());
        for (std::size_t i = 0; i < hits.size(); ++i) REQUIRE(same(originals[i], original_hit(blob, hits[i])));
        CHECK(originals[2]);
        CHECK(originals[3].status == QueryStatus::not_found);
        CHECK(originals[4].status == QueryStatus::invalid_argument);

        triangles[3] = no_triangle;
        triangles[4] = {blob.triangle_count()};
        std::vector<Result<OriginalTriangle>> sources(triangles.size());
        const Filled all_triangles = original_triangle(blob, triangles, sources);
        REQUIRE(all_triangles.status == QueryStatus::ok);
        REQUIRE(all_triangles.count == triangles.size());
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const Result<OriginalTriangle> found = original_triangle(blob, triangles[i]);
            REQUIRE(sources[i].status == found.status);
            REQUIRE(sources[i].value == found.value);
        }
        CHECK(sources[2]);
        CHECK(sources[3].status == QueryStatus::not_found);
        CHECK(sources[4].status == QueryStatus::invalid_argument);
        CHECK(sources[4].value == OriginalTriangle{});

        // Different sizes: nothing is written.
        const auto is_refused_whole = [](const Filled& filled) {
            return filled.status == QueryStatus::invalid_argument && filled.count == 0;
        };
        sources[0].status = QueryStatus::work_limit;
        CHECK(is_refused_whole(original_triangle(blob, triangles, std::span(sources).first(49))));
        CHECK(sources[0].status == QueryStatus::work_limit);
        originals[0].status = QueryStatus::work_limit;
        CHECK(is_refused_whole(original_hit(blob, hits, std::span(originals).first(49))));
        CHECK(originals[0].status == QueryStatus::work_limit);
        // A blob that is not open refuses each.
        const Filled refused = original_triangle(Blob(), triangles, sources);
        CHECK(refused.status == QueryStatus::not_open);
        CHECK(refused.count == sources.size());
        for (const auto& each : sources) CHECK(each.status == QueryStatus::not_open);
    });
}

TEST_CASE("source triangle: the status of an original hit is the reason for none") {
    for_each_profile([](Profile profile) {
        const Scene without = make_scene(profile, false, 0);
        const Scene scene = make_scene(profile, true, 0);
        RayHit hit;
        hit.triangle = {0};
        CHECK(original_hit(scene.opened.blob, hit).status == QueryStatus::ok);
        CHECK(original_hit(without.opened.blob, hit).status == QueryStatus::no_data);
        CHECK(original_hit(Blob(), hit).status == QueryStatus::not_open);
        CHECK_FALSE(original_hit(Blob(), hit));
        CHECK(OriginalHit().status == QueryStatus::not_open);
        const OriginalTriangle remap[] = {{1, 2, 3, 0}, {1, 2, 3, 3}};
        CHECK(original_hit(remap, hit).triangle == 3);
        CHECK(original_hit(std::span<const OriginalTriangle>{}, hit).status == QueryStatus::invalid_argument);
        hit.triangle = {1};
        CHECK(original_hit(remap, hit).status == QueryStatus::invalid_argument);  // its first corner is none
        hit.triangle = {2};
        CHECK(original_hit(remap, hit).status == QueryStatus::invalid_argument);
        hit.triangle = {scene.opened.blob.triangle_count()};
        CHECK(original_hit(scene.opened.blob, hit).status == QueryStatus::invalid_argument);
        hit.triangle = no_triangle;
        CHECK(original_hit(remap, hit).status == QueryStatus::not_found);
        CHECK(original_hit(scene.opened.blob, hit).status == QueryStatus::not_found);
        CHECK(original_hit(scene.opened.blob, hit).triangle == 0);

        Result<OriginalTriangle> original[1];
        const TriangleId first[1] = {{0}};
        CHECK(original_triangle(without.opened.blob, first, original).status == QueryStatus::no_data);
        CHECK(original[0].status == QueryStatus::no_data);
        CHECK(original_triangle(Blob(), first, original).status == QueryStatus::not_open);
        // An empty blob that was opened has no triangles, and no ids unless they were asked for.
        const OpenedBlob empty(Mesh{}, with_profile(profile));
        CHECK(original_hit(empty.blob, hit).status == QueryStatus::no_data);
    });
}

TEST_CASE("source triangle: ids of every width lead back with and without a first corner") {
    for_each_profile([](Profile profile) {
        const BakeOptions options = {.profile = profile, .original_ids = true};
        for (const unsigned side : {1u, 2u, 3u, 5u, 9u, 17u, 40u}) {
            Mesh mesh = make_plane_grid(side);
            if (side == 1) mesh.triangles.pop_back();  // ids of no bits
            const OpenedBlob opened(mesh, options);
            const DecodedBlob decoded = decode(opened.bytes);
            std::set<std::uint32_t> seen;
            for (std::uint32_t i = 0; i < opened.blob.triangle_count(); ++i) {
                const Result<OriginalTriangle> found = original_triangle(opened.blob, TriangleId{i});
                REQUIRE(found);
                const OriginalTriangle& original = *found;
                REQUIRE(original == OriginalTriangle{0, 0, decoded.original_ids[i], decoded.first_corners[i]});
                seen.insert(original.triangle);
            }
            CHECK(seen.size() == mesh.triangles.size());
        }
    });
}

TEST_CASE("source triangle: the last id is read within the blob") {
    for_each_profile([](Profile profile) {
        const auto bytes = bake_or_throw(
            make_plane_grid(4), {.profile = profile, .original_ids = true});  // 32 ids of 5 bits: nothing pads them
        const DecodedBlob decoded = decode(bytes);
        const GuardedPages pages(bytes, true);
        const Blob blob = open(pages.bytes());
        REQUIRE(blob);
        REQUIRE(blob.triangle_count() == 32);
        const Result<OriginalTriangle> found = original_triangle(blob, TriangleId{31});
        REQUIRE(found);
        const OriginalTriangle& original = *found;
        CHECK(original == OriginalTriangle{0, 0, decoded.original_ids[31], decoded.first_corners[31]});
    });
}

TEST_CASE("source triangle: absent ids and materials and triangles out of range give none") {
    for_each_profile([](Profile profile) {
        const Scene scene = make_scene(profile, false, 0);
        const auto status = [](const Blob& blob, std::uint32_t index) {
            const Result<OriginalTriangle> found = original_triangle(blob, {index});
            CHECK(found.value == OriginalTriangle{});
            return found.status;
        };
        CHECK(status(scene.opened.blob, 0) == QueryStatus::no_data);
        CHECK(material(scene.opened.blob, TriangleId{0}) == 0);
        CHECK_FALSE(scene.opened.blob.has_original_ids());
        CHECK_FALSE(scene.opened.blob.has_materials());

        const Scene with_ids = make_scene(profile, true, 16);
        const std::uint32_t count = with_ids.opened.blob.triangle_count();
        CHECK(status(with_ids.opened.blob, count) == QueryStatus::invalid_argument);
        CHECK(status(with_ids.opened.blob, no_triangle.index) == QueryStatus::not_found);
        CHECK(material(with_ids.opened.blob, TriangleId{count}) == 0);
        CHECK(status(Blob(), 0) == QueryStatus::not_open);
        CHECK(material(Blob(), TriangleId{0}) == 0);
    });
}

TEST_CASE("source triangle: optional sections keep the triangles and their order") {
    for_each_profile([](Profile profile) {
        const Scene plain = make_scene(profile, false, 0);
        const Scene full = make_scene(profile, true, 8);
        CHECK(plain.decoded.triangles == full.decoded.triangles);
        CHECK(plain.opened.bytes.size() < full.opened.bytes.size());
    });
}

}  // namespace
}  // namespace espalier::tests::identity_test
