// The tree changes nothing: every query, on every instruction set, gives the bits that the loop over all triangles
// gives.
#include "support/testing.hpp"

#include "support/answers/differences.hpp"
#include "support/machine/instruction_paths.hpp"
#include "support/meshes/real_meshes.hpp"

namespace espalier::tests::traversal_test {
namespace {

constexpr const char* ray_queries = "rays: closest, any, all, first few";
constexpr const char* segment_queries = "rays: segments";
constexpr const char* batch_queries = "rays: many in one call";
constexpr const char* sphere_queries = "spheres: any, all; closest point, k nearest";

void check_ray(const Blob& blob, const TriangleLoop& loop, const Ray& ray, std::uint64_t& hits) {
    require_none(ray_difference(blob, loop, ray, hits));
    require_none(segment_difference(blob, loop, {ray.origin, sum(ray.origin, ray.direction)}));
}

/// Many rays in one call against one call for each, which are held against the loop; a few in bundles, which share
/// their way through the tree.
void check_batch(const Blob& blob, std::vector<Ray> rays, Random& random) {
    for (std::size_t i = 0, single = rays.size(); i < single; i += 64) {
        const Ray ray = rays[i];
        const auto beside = [&](float x) { return x * (1.0f + 0x1p-10f * random.signed_unit()); };
        for (int k = 0; k < 16; ++k) {
            rays.push_back(ray);
            rays.back().direction = {beside(ray.direction.x), beside(ray.direction.y), beside(ray.direction.z)};
        }
    }
    std::vector<RayHit> hits(rays.size());
    std::vector<YesNo> answers(rays.size());
    REQUIRE(raycast(blob, rays, hits).status == QueryStatus::ok);
    REQUIRE(occluded(blob, rays, answers).status == QueryStatus::ok);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        CAPTURE(describe(rays[i]));
        const RayHit hit = raycast(blob, rays[i]);
        REQUIRE(same_bits(hits[i], hit));
        REQUIRE(answers[i].status() == hit.status);
    }
}

void check_sphere(const Blob& blob, const TriangleLoop& loop, const Sphere& sphere, std::uint64_t& overlaps) {
    require_none(sphere_difference(blob, loop, sphere, overlaps));
}

void check_rays_of_kind(const std::vector<TestBlob>& blobs, RayKind kind, std::uint64_t count) {
    std::uint64_t hits = 0;
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        const TriangleLoop loop(blob.decoded);
        QueryMaker maker(blob.decoded, 100 + static_cast<std::uint64_t>(kind));
        std::vector<Ray> rays;
        for (std::uint64_t i = 0; i < count; ++i) {
            rays.push_back(maker.ray(kind));
            if (maker.random().below(3) == 0) maker.restrict(rays.back());
            check_ray(blob.opened.blob, loop, rays.back(), hits);
        }
        check_batch(blob.opened.blob, rays, maker.random());
    }
    const std::uint64_t asked = count * blobs.size();
    const std::uint64_t random = kind == RayKind::incoherent ? asked : 0;
    for (const char* queries : {ray_queries, segment_queries, batch_queries})
        MESSAGE(calls_made(queries, generated_meshes, random, asked - random));
    // Queries that all miss would prove nothing.
    CHECK(hits > asked / 5);
}

/// As many random spheres as awkward ones.
void check_spheres(const std::vector<TestBlob>& blobs, std::uint64_t count) {
    for (const TestBlob& blob : blobs) {
        CAPTURE(blob.name);
        const TriangleLoop loop(blob.decoded);
        QueryMaker maker(blob.decoded, 200);
        std::uint64_t overlaps = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            check_sphere(blob.opened.blob, loop, maker.sphere(), overlaps);
            check_sphere(blob.opened.blob, loop, maker.random_sphere(), overlaps);
        }
        if (asks_enough()) CHECK(overlaps > count / 10);
    }
    MESSAGE(calls_made(sphere_queries, generated_meshes, count * blobs.size(), count * blobs.size()));
}

/// Times a scale of 1,000 these are at least the counts that a release must show, all profiles together.
void check_real_mesh(const Mesh& mesh, Profile profile) {
    const OpenedBlob opened(mesh, with_profile(profile));
    const DecodedBlob decoded = decode(opened.bytes);
    const TriangleLoop loop(decoded);
    QueryMaker maker(decoded, 300 + static_cast<std::uint64_t>(profile));
    const std::uint64_t count = scaled_share(decoded.triangles.size() > 200'000 ? 10 : 101);
    std::uint64_t hits = 0, overlaps = 0;
    std::vector<Ray> rays;
    for (std::uint64_t i = 0; i < count; ++i) {
        for (const RayKind kind :
             {RayKind::incoherent, all_ray_kinds[1 + maker.random().below(all_ray_kinds.size() - 1)]}) {
            rays.push_back(maker.ray(kind));
            if (maker.random().below(4) == 0) maker.restrict(rays.back());
            check_ray(opened.blob, loop, rays.back(), hits);
        }
    }
    check_batch(opened.blob, rays, maker.random());
    const std::uint64_t awkward_spheres = (count + 4) / 5;
    for (std::uint64_t i = 0; i < count; ++i) check_sphere(opened.blob, loop, maker.random_sphere(), overlaps);
    for (std::uint64_t i = 0; i < awkward_spheres; ++i) check_sphere(opened.blob, loop, maker.sphere(), overlaps);
    for (const char* queries : {ray_queries, segment_queries, batch_queries})
        MESSAGE(calls_made(queries, mesh.name, count, count));
    MESSAGE(calls_made(sphere_queries, mesh.name, count, awkward_spheres));
    if (count >= 20) CHECK(hits > 0);  // fewer may all miss
}

TEST_CASE("ray: random rays equal the loop on every path") {
    for (const InstructionPath& path : instruction_paths()) MESSAGE("instruction set: ", std::string(path.name));
    check_rays_of_kind(small_test_blobs(), RayKind::incoherent, scaled_share(500));
    check_rays_of_kind(medium_test_blobs(), RayKind::incoherent, scaled_share(100));
}

TEST_CASE("ray: rays of every awkward kind equal the loop on every path") {
    for (const RayKind kind : std::span(all_ray_kinds).subspan(1)) {
        CAPTURE(static_cast<int>(kind));
        check_rays_of_kind(small_test_blobs(), kind, scaled_share(500));
        check_rays_of_kind(medium_test_blobs(), kind, scaled_share(100));
    }
}

TEST_CASE("closest point: spheres and closest points equal the loop on every path") {
    check_spheres(small_test_blobs(), scaled_share(400));
    check_spheres(medium_test_blobs(), scaled_share(60));
}

TEST_CASE("ray: rays and spheres and closest points equal the loop on real meshes") {
    for_each_real_mesh(check_real_mesh);
}

}  // namespace
}  // namespace espalier::tests::traversal_test
