// Claims about espalier.h: called from C, every query answers what it answers C++.
#include <doctest/doctest.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

#include "both.hpp"
#include "fixtures.hpp"
#include "support/base/profiles.hpp"
#include "support/base/test_scale.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

OpenedBlob blob_with_materials_alone() {
    Mesh mesh = make_cube(-1.0f, 1.0f);
    mesh.materials.assign(mesh.triangles.size(), 5);
    return {mesh, BakeOptions()};
}

/// Requires that each function which takes such an object found something at least once.
void check_answered(const Both& both, Takes takes) {
    for (const Entry& entry : entries)
        if (entry.takes == takes) CHECK_MESSAGE(both.answered.count(entry.name) == 1, std::string(entry.name));
}

}  // namespace

TEST_CASE("c api: every query gives the bits of C++") {
    std::vector<OpenedBlob> special;
    for (const Profile profile : every_profile) special.push_back(blob_with_everything(profile));
    special.push_back(blob_with_materials_alone());
    special.push_back(blob_with_copies());
    std::vector<const OpenedBlob*> blobs;
    for (const TestBlob& blob : small_test_blobs()) blobs.push_back(&blob.opened);
    for (const OpenedBlob& blob : special) blobs.push_back(&blob);
    Random random(1);
    Both both;
    for (const OpenedBlob* opened : blobs) {
        REQUIRE(both.open(opened->bytes) == OpenStatus::ok);
        REQUIRE(both.open(blobs[random.below(static_cast<std::uint32_t>(blobs.size()))]->bytes, 1) == OpenStatus::ok);
        for (std::uint64_t i = 0; i < scaled(30); ++i) both.compare(Takes::blob, some_question(opened->blob, random));
    }
    both.answered.insert("read_remap");  // below
    if (asks_enough()) check_answered(both, Takes::blob);
}

TEST_CASE("c api: every query of a scene gives the bits of C++") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Both both;
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    REQUIRE(both.scene().meshes().size() > 2);
    Random random(12);
    for (std::uint64_t i = 0; i < scaled(800); ++i) both.compare(Takes::scene, some_question(both.scene(), random));
    if (asks_enough()) check_answered(both, Takes::scene);
}

TEST_CASE("c api: a remap is read into the array of C") {
    Mesh cube = make_cube(-1.0f, 1.0f);
    const MeshView view = cube.view();
    const BakeResult baked = bake(std::span(&view, 1));
    const std::vector<std::byte> file = remap_file(baked);
    Both both;
    REQUIRE(both.open(baked.bytes) == OpenStatus::ok);
    espalier_original_triangle remap[12];
    CHECK(c99_read_remap(file.data(), file.size(), &both.c->blob[0], remap, 12) == ESPALIER_OPEN_OK);
    CHECK(std::equal(baked.remap.begin(), baked.remap.end(), spanned<OriginalTriangle>(remap, 12).begin()));
}

TEST_CASE("c api: a ray and a transform from C have the defaults of C++") {
    const espalier_ray ray = c99_default_ray({1, 2, 3}, {4, 5, 6});
    const Ray in_cpp = {.origin = {1, 2, 3}, .direction = {4, 5, 6}};
    CHECK(to<Ray>(&ray).origin == in_cpp.origin);
    CHECK(to<Ray>(&ray).direction == in_cpp.direction);
    CHECK(ray.t_min == in_cpp.t_min);
    CHECK(ray.t_max == in_cpp.t_max);
    CHECK(ray.culling == static_cast<espalier_face_culling>(in_cpp.culling));
    const espalier_transform identity = c99_identity();
    CHECK(to<Transform>(&identity) == Transform());
    for (std::size_t i = 0; i < KDop::count; ++i) CHECK(to<Vec3>(&espalier_k_dop_directions[i]) == KDop::directions[i]);
}

TEST_CASE("c api: every status has the same sentence and meaning in C") {
    for (unsigned value = 0; value < 256; ++value) {
        const auto byte = static_cast<std::uint8_t>(value);
        CHECK(std::string(c99_describe_open_status(byte)) == describe(OpenStatus{byte}));
        CHECK(std::string(c99_describe_query_status(byte)) == describe(QueryStatus{byte}));
        CHECK(c99_yes({byte}) == (byte == ESPALIER_QUERY_OK));
        CHECK(c99_no({byte}) == (byte == ESPALIER_QUERY_NOT_FOUND));
        CHECK(c99_is_refused(byte) == (byte >= 16));
    }
}
