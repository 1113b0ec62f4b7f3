// Scenes that a program in C bakes, and the deep check from C: bytes and verdicts are those of C++.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <espalier/scenes/bake.hpp>

#include "c/baking/given.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/makers.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

Bytes some_blob(float size) { return bake_or_throw(make_cube(-size, size)); }

espalier_bytes in_c(const Bytes& bytes) { return {bytes.data(), bytes.size()}; }

Bytes copied(const espalier_bake_result& result) {
    const std::span<const std::byte> bytes = bytes_of(result);
    return {bytes.begin(), bytes.end()};
}

/// Returns three instances of two blobs, for C++.
std::vector<Instance> some_instances() {
    std::vector<Instance> instances(3);
    for (std::uint32_t i = 0; i < 3; ++i) {
        instances[i].transform.translation = {static_cast<float>(4 * i), 1.0f, 2.0f};
        instances[i].mesh = i % 2;
        instances[i].user = 100 + i;
    }
    return instances;
}
std::vector<espalier_instance> in_c(const std::vector<Instance>& instances) {
    std::vector<espalier_instance> result(instances.size());
    std::memcpy(result.data(), instances.data(), instances.size() * sizeof(Instance));
    return result;
}

void check_refused(const espalier_bake_result* given, espalier_bake_status status, const char* words) {
    const BakedFromC result(given);
    CHECK(result->status == status);
    CHECK(result->bytes == nullptr);
    CHECK(std::string(result->message).find(words) != std::string::npos);
}

}  // namespace

TEST_CASE("c api: a scene has the bytes of the same scene from C++") {
    const Bytes small = some_blob(1.0f), large = some_blob(2.0f);
    const std::array blobs = {in_c(small), in_c(large)};
    const std::array<std::span<const std::byte>, 2> spans = {small, large};
    const std::vector<Instance> instances = some_instances();
    const std::vector<espalier_instance> given = in_c(instances);
    const SceneBakeResult expected = bake_scene(spans, instances);
    REQUIRE(expected);
    const BakedFromC result(c99_bake_scene(blobs.data(), 2, given.data(), given.size(), nullptr));
    REQUIRE(result->status == ESPALIER_BAKE_OK);
    CHECK(std::string(result->message).empty());
    CHECK(copied(*result) == expected.bytes);
    const BakedFromC verdict(c99_verify_scene(result->bytes, result->byte_count));
    CHECK(verdict->status == ESPALIER_BAKE_OK);
    CHECK(verdict->bytes == nullptr);
    check_refused(c99_verify(result->bytes, result->byte_count), ESPALIER_BAKE_NOT_SOUND, "");
    const BakedFromC empty(c99_bake_scene(nullptr, 0, nullptr, 0, nullptr));
    CHECK(empty->status == ESPALIER_BAKE_OK);
    CHECK(copied(*empty) == bake_scene({}, {}).bytes);
}

TEST_CASE("c api: a scene has the translations and the origin of the same scene from C++") {
    const Bytes blob = some_blob(1.0f);
    const espalier_bytes one = in_c(blob);
    const std::array<std::span<const std::byte>, 1> spans = {blob};
    const std::vector<Instance> instances(2);
    const std::vector<espalier_instance> given = in_c(instances);
    const std::array far = {Vec3d{5e6 + 0.125, 1.0, 2.0}, Vec3d{5e6 + 4.1, 0.0, 0.0}};
    const std::array far_in_c = {espalier_vec3d{5e6 + 0.125, 1.0, 2.0}, espalier_vec3d{5e6 + 4.1, 0.0, 0.0}};
    espalier_scene_bake_options options;
    c99_init_scene_bake_options(&options, sizeof options);
    CHECK(options.translations == nullptr);
    CHECK(options.chooses_origin == 0);
    c99_init_scene_bake_options(nullptr, sizeof options);
    options.translations = far_in_c.data();
    for (const std::optional<Vec3d>& origin :
         {std::optional<Vec3d>(), std::optional(Vec3d{5e6, 0.0, 1.0}), std::optional(Vec3d{})}) {
        const SceneBakeResult expected = bake_scene(spans, instances, {far, origin});
        REQUIRE(expected);
        options.chooses_origin = origin ? 0 : 1;
        if (origin) options.origin = {origin->x, origin->y, origin->z};
        const BakedFromC result(c99_bake_scene(&one, 1, given.data(), 2, &options));
        REQUIRE(result->status == ESPALIER_BAKE_OK);
        CHECK(copied(*result) == expected.bytes);
        CHECK(result->report->max_error == double(expected.report.max_error));
        CHECK(result->report->bytes == expected.bytes.size());
        CHECK(result->report->origin.x == expected.report.origin.x);
        REQUIRE(result->report->warning_count == expected.report.warnings.size());
        CHECK((result->report->warning_count == 1) == (origin == Vec3d{}));
        if (origin == Vec3d{}) CHECK(result->report->warnings[0].message == expected.report.warnings[0].message);
        espalier_blob mesh;
        espalier_scene scene;
        REQUIRE(c99_open_scene(result->bytes, result->byte_count, &mesh, 1, nullptr, 0, &scene) == ESPALIER_OPEN_OK);
        const espalier_vec3d stored = c99_scene_source_origin(&scene);
        CHECK(Vec3d{stored.x, stored.y, stored.z} == expected.report.origin);
    }
    options.origin.y = std::numeric_limits<double>::quiet_NaN();
    check_refused(c99_bake_scene(&one, 1, given.data(), 2, &options), ESPALIER_BAKE_INVALID_OPTIONS, "origin");
    for (const std::size_t size : {sizeof options - 1, sizeof options + 1}) {
        options.size = size;
        check_refused(c99_bake_scene(&one, 1, given.data(), 2, &options), ESPALIER_BAKE_INVALID_ARGUMENT, "size");
    }
}

TEST_CASE("c api: a scene that cannot be baked is refused with the reason") {
    const Bytes blob = some_blob(1.0f);
    espalier_bytes one = in_c(blob);
    std::vector<espalier_instance> given = in_c(some_instances());
    check_refused(c99_bake_scene(&one, 1, given.data(), 3, nullptr), ESPALIER_BAKE_INVALID_MESH, "instance 1");
    check_refused(c99_bake_scene(nullptr, 1, given.data(), 1, nullptr), ESPALIER_BAKE_INVALID_ARGUMENT,
                  "blobs is null");
    check_refused(c99_bake_scene(&one, 1, nullptr, 1, nullptr), ESPALIER_BAKE_INVALID_ARGUMENT, "instances is null");
    one.bytes = nullptr;
    check_refused(c99_bake_scene(&one, 1, given.data(), 1, nullptr), ESPALIER_BAKE_INVALID_ARGUMENT, "blob 0");
    one = {blob.data(), blob.size() - 1};
    check_refused(c99_bake_scene(&one, 1, given.data(), 1, nullptr), ESPALIER_BAKE_INVALID_MESH, "");
}

TEST_CASE("c api: borders are joined as from C++ and what is refused is unchanged") {
    std::vector<Bytes> tiles;
    for (const float x : {0.0f, 4.0f}) {
        const Mesh tile = moved_by(make_plane_grid(4), {x, 0.0f, 0.0f});  // 4 wide
        tiles.push_back(OpenedBlob(tile, {.resolution = Resolution::step(-8), .flat_angle = 5.0}).bytes);
    }
    const auto untouched = tiles, expected = [&] {
        auto joined = tiles;
        const std::array<JoinedBlob, 2> blobs = {JoinedBlob{joined[0], {}}, JoinedBlob{joined[1], {}}};
        CHECK(join_borders(blobs).edges > 0);
        return joined;
    }();
    std::array<espalier_joined_blob, 2> given = {};
    for (std::size_t i = 0; i < 2; ++i) given[i] = {tiles[i].data(), tiles[i].size(), {0.0f, 0.0f, 0.0f}};
    given[1].translation.x = 0x1p-9f;
    std::uint64_t edges = 9;
    const BakedFromC refused(c99_join_borders(given.data(), 2, &edges));
    CHECK(refused->status == ESPALIER_BAKE_INVALID_MESH);
    CHECK(std::string(refused->message).find("blob 1") == 0);
    CHECK(edges == 0);
    CHECK(tiles == untouched);
    given[1].translation.x = 0.0f;
    const BakedFromC joined(c99_join_borders(given.data(), 2, &edges));
    CHECK(joined->status == ESPALIER_BAKE_OK);
    CHECK(edges > 0);
    CHECK(tiles == expected);
    const BakedFromC again(c99_join_borders(given.data(), 2, nullptr));
    CHECK(again->status == ESPALIER_BAKE_OK);
    given[0].bytes = nullptr;
    check_refused(c99_join_borders(given.data(), 2, nullptr), ESPALIER_BAKE_INVALID_ARGUMENT, "blob 0");
    check_refused(c99_join_borders(nullptr, 1, nullptr), ESPALIER_BAKE_INVALID_ARGUMENT, "blobs is null");
    CHECK(BakedFromC(c99_join_borders(nullptr, 0, nullptr))->status == ESPALIER_BAKE_OK);
}

TEST_CASE("c api: the deep check has the verdict of C++") {
    Bytes blob = some_blob(1.0f);
    const BakedFromC sound(c99_verify(blob.data(), blob.size()));
    CHECK(sound->status == ESPALIER_BAKE_OK);
    CHECK(std::string(sound->message).empty());
    for (std::size_t i = 0; i < blob.size(); i += 7) {
        blob[i] ^= std::byte{4};
        const VerifyReport expected = verify(blob);
        const BakedFromC result(c99_verify(blob.data(), blob.size()));
        CHECK((result->status == ESPALIER_BAKE_OK) == expected.sound);
        CHECK(result->message == expected.message);
        blob[i] ^= std::byte{4};
    }
    check_refused(c99_verify(nullptr, 8), ESPALIER_BAKE_INVALID_ARGUMENT, "bytes is null");
    check_refused(c99_verify(nullptr, 0), ESPALIER_BAKE_NOT_SOUND, "");
    check_refused(c99_verify_scene(blob.data(), blob.size()), ESPALIER_BAKE_NOT_SOUND, "");
}
