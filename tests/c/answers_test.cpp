// Claims about espalier.h: asked from C, every query answers what it answers C++.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "comparing.hpp"
#include "expecting.hpp"
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

}  // namespace

TEST_SUITE("answers") {
    TEST_CASE("c api: every query gives the bits of C++") {
        std::vector<OpenedBlob> special;
        for (const Profile profile : every_profile) special.push_back(blob_with_everything(profile));
        special.push_back(blob_with_materials_alone());
        special.push_back(blob_with_copies());
        std::vector<const OpenedBlob*> blobs;
        for (const TestBlob& blob : small_test_blobs()) blobs.push_back(&blob.opened);
        for (const OpenedBlob& blob : special) blobs.push_back(&blob);
        Random random(1);
        for (const OpenedBlob* opened : blobs) {
            const OpenedBlob& other = *blobs[random.below(static_cast<std::uint32_t>(blobs.size()))];
            const espalier_blob c_blob = open_from_c(opened->bytes), c_other = open_from_c(other.bytes);
            for (std::uint64_t i = 0; i < scaled(20); ++i)
                compare_all(c_blob, c_other, opened->blob, other.blob, some_question(opened->blob, random));
        }
    }

    TEST_CASE("c api: every query of a scene gives the bits of C++") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        const SceneOfBoth both(bytes);
        REQUIRE(both.c_status == ESPALIER_OPEN_OK);
        REQUIRE(both.scene);
        REQUIRE(both.meshes.size() > 2);
        Random random(12);
        std::uint64_t hits = 0, contacts = 0;
        const std::uint64_t rounds = scaled(500);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            const question asked = some_question(both.scene, random);
            compare_scenes(both.c_scene, both.scene, asked);
            const Vec3 from = cpp(asked.points[0]), way = cpp(asked.directions[0]);
            hits += raycast(both.scene, {.origin = from, .direction = way}) ? 1u : 0u;
            contacts += sweep(both.scene, Sphere{from, asked.lengths[0]}, way) ? 1u : 0u;
        }
        if (asks_enough()) CHECK(hits > rounds / 16);
        if (asks_enough()) CHECK(contacts > rounds / 16);
    }

    TEST_CASE("c api: a blob filled with zeros is the empty blob") {
        espalier_blob zero;
        std::memset(&zero, 0, sizeof zero);
        static const Blob empty;  // static, so that what lies between its fields is zero too
        CHECK(std::memcmp(&zero, static_cast<const void*>(&empty), sizeof zero) == 0);
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        const espalier_blob c_opened = open_from_c(opened.bytes);
        Random random(2);
        for (std::uint64_t i = 0; i < scaled(50); ++i) {
            const question asked = some_question(opened.blob, random);
            compare_all(zero, zero, empty, empty, asked);
            compare_all(zero, c_opened, empty, opened.blob, asked);
            compare_all(c_opened, zero, opened.blob, empty, asked);
        }
    }

    TEST_CASE("c api: a scene filled with zeros is the empty scene") {
        espalier_scene zero;
        std::memset(&zero, 0, sizeof zero);
        static const BakedScene empty;  // static, so that what lies between its fields is zero too
        CHECK(std::memcmp(&zero, static_cast<const void*>(&empty), sizeof zero) == 0);
        const OpenedBlob opened = blob_with_everything(Profile::fast);
        const std::vector<std::byte> bytes = bake_instances({});
        const SceneOfBoth nothing(bytes);
        REQUIRE(nothing.c_status == ESPALIER_OPEN_OK);
        Random random(13);
        for (std::uint64_t i = 0; i < scaled(50); ++i) {
            const question asked = some_question(opened.blob, random);
            compare_scenes(zero, empty, asked);
            compare_scenes(nothing.c_scene, nothing.scene, asked);
        }
    }

    TEST_CASE("c api: a ray and a transform from C have the defaults of C++") {
        const Ray ray = {.origin = {1, 2, 3}, .direction = {4, 5, 6}};
        const espalier_ray c_ray = espalier_default_ray({1, 2, 3}, {4, 5, 6});
        CHECK(c(ray.origin).x == c_ray.origin.x);
        CHECK(c(ray.direction).z == c_ray.direction.z);
        CHECK(ray.t_min == c_ray.t_min);
        CHECK(ray.t_max == c_ray.t_max);
        CHECK(static_cast<espalier_face_culling>(ray.culling) == c_ray.culling);
        const Transform transform;
        const espalier_transform c_transform = espalier_identity();
        CHECK(std::memcmp(&transform, &c_transform, sizeof transform) == 0);
    }

    TEST_CASE("c api: every status has the same sentence in C") {
        for (unsigned value = 0; value < 256; ++value) {
            const auto byte = static_cast<std::uint8_t>(value);
            CHECK(std::string(espalier_describe_open_status(byte)) == describe(OpenStatus{byte}));
            CHECK(std::string(espalier_describe_query_status(byte)) == describe(QueryStatus{byte}));
        }
    }

    TEST_CASE("c api: opening gives the status of C++ and no half-open blob") {
        const OpenedBlob good = blob_with_everything(Profile::balanced);
        CHECK(misbehaviour_of_open(good.bytes.data(), good.bytes.size()) == 0);
        std::vector<std::byte> bytes(good.bytes.begin(), good.bytes.end());
        Random random(3);
        for (int i = 0; i < 500; ++i) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
            const std::byte was = bytes[at];
            bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
            espalier_blob c_blob;
            const OpenStatus status = open(bytes).status();
            REQUIRE(espalier_open(bytes.data(), bytes.size(), &c_blob) == static_cast<espalier_open_status>(status));
            REQUIRE(espalier_open_unchecked(bytes.data(), bytes.size(), &c_blob) ==
                    static_cast<espalier_open_status>(open_unchecked(bytes).status()));
            bytes[at] = was;
        }
    }
    TEST_CASE("c api: opening a scene gives the status of C++ and no half-open scene") {
        const std::vector<std::byte> good = bake_instances(some_instances());
        CHECK(misbehaviour_of_open_scene(good.data(), good.size()) == 0);
        const OpenedBlob blob = blob_with_everything(Profile::fast);
        CHECK(SceneOfBoth(blob.bytes).c_status == ESPALIER_OPEN_NOT_A_SCENE);
        std::vector<std::byte> bytes = good;
        Random random(14);
        for (int i = 0; i < 500; ++i) {
            const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
            bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
            const SceneOfBoth both(bytes);
            REQUIRE(both.c_status == static_cast<espalier_open_status>(both.scene.status()));
            REQUIRE(espalier_scene_status(&both.c_scene) == both.c_status);
            bytes[at] = good[at];
        }
    }
}
