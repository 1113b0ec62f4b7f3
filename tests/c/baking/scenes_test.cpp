// Scenes that a program in C bakes, and the deep check from C: bytes and verdicts are those of C++.
#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <espalier/bake.hpp>
#include <espalier/scene.hpp>

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
    const BakedFromC result(c99_bake_scene(blobs.data(), 2, given.data(), given.size()));
    REQUIRE(result->status == ESPALIER_BAKE_OK);
    CHECK(std::string(result->message).empty());
    CHECK(copied(*result) == expected.bytes);
    const BakedFromC verdict(c99_verify_scene(result->bytes, result->byte_count));
    CHECK(verdict->status == ESPALIER_BAKE_OK);
    CHECK(verdict->bytes == nullptr);
    check_refused(c99_verify(result->bytes, result->byte_count), ESPALIER_BAKE_NOT_SOUND, "");
    const BakedFromC empty(c99_bake_scene(nullptr, 0, nullptr, 0));
    CHECK(empty->status == ESPALIER_BAKE_OK);
    CHECK(copied(*empty) == bake_scene({}, {}).bytes);
}

TEST_CASE("c api: a scene that cannot be baked is refused with the reason") {
    const Bytes blob = some_blob(1.0f);
    espalier_bytes one = in_c(blob);
    std::vector<espalier_instance> given = in_c(some_instances());
    check_refused(c99_bake_scene(&one, 1, given.data(), 3), ESPALIER_BAKE_INVALID_MESH, "instance 1");
    check_refused(c99_bake_scene(nullptr, 1, given.data(), 1), ESPALIER_BAKE_INVALID_ARGUMENT, "blobs is null");
    check_refused(c99_bake_scene(&one, 1, nullptr, 1), ESPALIER_BAKE_INVALID_ARGUMENT, "instances is null");
    one.bytes = nullptr;
    check_refused(c99_bake_scene(&one, 1, given.data(), 1), ESPALIER_BAKE_INVALID_ARGUMENT, "blob 0");
    one = {blob.data(), blob.size() - 1};
    check_refused(c99_bake_scene(&one, 1, given.data(), 1), ESPALIER_BAKE_INVALID_MESH, "");
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
