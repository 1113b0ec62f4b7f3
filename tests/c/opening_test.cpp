// Claims about opening from C: the status of C++, at aligned addresses alone, and no half-open handles.
#include <doctest/doctest.h>

#include <cstddef>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <c99.h>

#include "both.hpp"
#include "fixtures.hpp"
#include "room.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/exact_buffer.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::size_t most = 16;

bool is_empty(const espalier_blob& blob) { return c99_blob_size(&blob) == 0 && c99_blob_triangle_count(&blob) == 0; }

bool is_empty(const espalier_scene& scene) {
    std::size_t meshes = 99, tiles = 99;
    return c99_scene_meshes(&scene, &meshes) == nullptr && meshes == 0 && c99_scene_size(&scene) == 0 &&
           c99_scene_tiles(&scene, &tiles) == nullptr && tiles == 0 && c99_scene_instance_count(&scene) == 0;
}

/// Returns whether of all meshes exactly the first ones are open and the others empty.
bool are_open(const Room<espalier_blob>& meshes, std::size_t open) {
    for (std::size_t i = 0; i < most; ++i)
        if (c99_blob_status(&meshes.array[i]) != (i < open ? ESPALIER_OPEN_OK : ESPALIER_OPEN_NOT_OPENED)) return false;
    return true;
}

}  // namespace

TEST_CASE("c api: a blob opens at aligned addresses alone and can be copied") {
    const OpenedBlob opened = blob_with_everything(Profile::balanced);
    const std::byte* const bytes = opened.bytes.data();
    const std::size_t size = opened.bytes.size();
    for (const auto open_it : {c99_open, c99_open_unchecked}) {
        Room<espalier_blob> room;
        REQUIRE(open_it(bytes, size, room.array) == ESPALIER_OPEN_OK);
        const espalier_blob copy = room.array[0];
        room.clear();
        CHECK(c99_blob_size(&copy) == size);
        CHECK(open_it(nullptr, 0, room.array) == ESPALIER_OPEN_TOO_SHORT);
        CHECK(is_empty(room.array[0]));
        check_misaligned<espalier_blob>(
            16, [&](espalier_blob* blob) { return open_it(bytes, size, blob) == ESPALIER_OPEN_MISALIGNED; });
    }
}

TEST_CASE("c api: a damaged blob opens with the status of C++") {
    const OpenedBlob good = blob_with_everything(Profile::balanced);
    std::vector<std::byte> bytes(good.bytes.begin(), good.bytes.end());
    Random random(3);
    Both both;
    for (int i = 0; i < 500; ++i) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
        bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
        static_cast<void>(both.open(bytes));
        REQUIRE(c99_open_unchecked(bytes.data(), bytes.size(), &both.c->blob[0]) ==
                static_cast<espalier_open_status>(open_unchecked(bytes).status()));
        bytes[at] = good.bytes[at];
    }
}

TEST_CASE("c api: each size but the right one is refused and leaves an empty handle") {
    const OpenedBlob good = blob_with_everything(Profile::small);
    Random random(4);
    Both both;
    espalier_blob& blob = both.c->blob[0];
    const auto check = [&](const std::byte* bytes, std::size_t size, espalier_open_status expected) {
        for (const auto open_it : {c99_open, c99_open_unchecked}) {
            REQUIRE(c99_open(good.bytes.data(), good.bytes.size(), &blob) == ESPALIER_OPEN_OK);  // must not be left
            REQUIRE(open_it(bytes, size, &blob) == expected);
            REQUIRE(c99_blob_status(&blob) == expected);
            REQUIRE(is_empty(blob));
        }
        both.cpp->blob[0] = std::bit_cast<espalier_blob>(open({bytes, size}));
        if (random.below(64) == 0) both.compare(Takes::blob, some_question(good.blob, random));
    };
    for (std::size_t size = 0; size < good.bytes.size(); ++size) {
        const ExactBuffer shorter(std::span(good.bytes).first(size));
        check(shorter.bytes().data(), size, ESPALIER_OPEN_TOO_SHORT);
    }
    std::vector<std::byte> longer(good.bytes.begin(), good.bytes.end());
    for (int more = 0; more < 20; ++more) {
        longer.push_back(std::byte{0});
        check(longer.data(), longer.size(), ESPALIER_OPEN_TRAILING_BYTES);
    }
    // The header alone refuses these, also where their lowest 32 bits are those of the right size.
    check(longer.data(), std::numeric_limits<std::size_t>::max(), ESPALIER_OPEN_TRAILING_BYTES);
    if constexpr (sizeof(std::size_t) > 4)
        check(longer.data(), good.bytes.size() + (std::size_t{1} << 16 << 16), ESPALIER_OPEN_TRAILING_BYTES);
}

TEST_CASE("c api: a scene opens with enough places for meshes and tiles alone and can be copied") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    const std::uint32_t count = c99_scene_mesh_count(bytes.data(), bytes.size());
    Room<espalier_blob> meshes;
    Room<espalier_scene> tiles, scenes;
    espalier_scene& scene = scenes.array[0];
    // Opens into memory that was something else before; meshes without a place are empty.
    const auto open_anew = [&](std::size_t size, std::size_t capacity, std::size_t tile_capacity = most) {
        std::memset(static_cast<void*>(meshes.array), 0, sizeof meshes.array);
        std::memset(static_cast<void*>(meshes.array), 0xA5, capacity * sizeof(espalier_blob));
        scenes.clear();
        return c99_open_scene(bytes.data(), size, meshes.array, capacity, tiles.array, tile_capacity, &scene);
    };
    REQUIRE(count > 2);
    REQUIRE(count < most);
    CHECK(c99_scene_mesh_count(bytes.data(), bytes.size() - 1) == 0);
    CHECK(c99_scene_mesh_count(nullptr, 0) == 0);
    REQUIRE(open_anew(bytes.size(), count) == ESPALIER_OPEN_OK);
    CHECK(are_open(meshes, count));
    const espalier_scene copy = scene;
    scenes.clear();
    std::size_t counted = 0;
    CHECK(c99_scene_status(&copy) == ESPALIER_OPEN_OK);
    CHECK(c99_scene_size(&copy) == bytes.size());
    CHECK(c99_scene_meshes(&copy, &counted) == meshes.array);
    CHECK(counted > 0);
    CHECK(counted <= count);
    CHECK(open_anew(bytes.size(), most) == ESPALIER_OPEN_OK);
    CHECK(are_open(meshes, count));
    for (std::size_t capacity = 0; capacity < count; ++capacity) {
        CHECK(open_anew(bytes.size(), capacity) == ESPALIER_OPEN_TOO_FEW_MESHES);
        CHECK(is_empty(scene));
        CHECK(c99_scene_status(&scene) == ESPALIER_OPEN_TOO_FEW_MESHES);
        CHECK(are_open(meshes, capacity < counted ? 0 : counted));  // those that are not in tiles
    }
    CHECK(c99_open_scene(bytes.data(), bytes.size(), nullptr, 0, nullptr, 0, &scene) == ESPALIER_OPEN_TOO_FEW_MESHES);
    CHECK(open_anew(bytes.size() - 1, most) == ESPALIER_OPEN_TOO_SHORT);
    CHECK(is_empty(scene));
    CHECK(are_open(meshes, 0));
    for (std::size_t i = 0; i < c99_scene_tile_count(bytes.data(), bytes.size()); ++i)
        CHECK(open_anew(bytes.size(), most, i) == ESPALIER_OPEN_TOO_FEW_MESHES);
    scenes.clear();
    CHECK(c99_open_scene(nullptr, 0, nullptr, 0, nullptr, 0, &scene) == ESPALIER_OPEN_TOO_SHORT);
    CHECK(is_empty(scene));

    const auto is_misaligned = [&](espalier_blob* blobs, espalier_scene* others, espalier_scene* place) {
        return c99_open_scene(bytes.data(), bytes.size(), blobs, most, others, most, place) == ESPALIER_OPEN_MISALIGNED;
    };
    check_misaligned<espalier_blob>(16, [&](auto* at) { return is_misaligned(at, tiles.array, &scene); });
    check_misaligned<espalier_scene>(16, [&](auto* at) { return is_misaligned(meshes.array, at, &scene); });
    check_misaligned<espalier_scene>(16, [&](auto* at) { return is_misaligned(meshes.array, tiles.array, at); });
}

TEST_CASE("c api: a damaged scene opens with the status of C++") {
    const std::vector<std::byte> good = bake_instances(some_instances());
    const OpenedBlob blob = blob_with_everything(Profile::fast);
    Both both;
    CHECK(both.open_scene(blob.bytes) == OpenStatus::not_a_scene);
    std::vector<std::byte> bytes = good;
    Random random(14);
    for (int i = 0; i < 500; ++i) {
        const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
        bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
        const OpenStatus status = both.open_scene(bytes);
        REQUIRE(c99_scene_status(&both.c->scene[0]) == static_cast<espalier_open_status>(status));
        bytes[at] = good[at];
    }
}

TEST_CASE("c api: handles filled with zeros are those that were never opened") {
    const Both zero;  // of C filled with zeros
    const auto are_equal = [](const auto& in_c, const auto& in_cpp) {
        return std::memcmp(&in_c, &in_cpp, sizeof in_c) == 0;
    };
    static const Blob blob;  // static, so that what lies between its fields is zero too
    static const BakedScene scene;
    static const MovingScene moving;
    CHECK(are_equal(zero.c->blob[0], blob));
    CHECK(are_equal(zero.c->scene[0], scene));
    CHECK(are_equal(zero.c->moving_scene[0], moving));
    CHECK(is_empty(zero.c->blob[0]));
    CHECK(is_empty(zero.c->scene[0]));
    CHECK(c99_blob_status(&zero.c->blob[0]) == ESPALIER_OPEN_NOT_OPENED);
    CHECK(c99_scene_status(&zero.c->scene[0]) == ESPALIER_OPEN_NOT_OPENED);

    const OpenedBlob opened = blob_with_everything(Profile::fast);
    const std::vector<std::byte> without_instances = bake_instances({});
    Random random(2);
    for (std::uint64_t i = 0; i < scaled(50); ++i) {
        Both both;
        if (i % 3 == 1) REQUIRE(both.open(opened.bytes) == OpenStatus::ok);
        if (i % 3 == 2) REQUIRE(both.open(opened.bytes, 1) == OpenStatus::ok);
        if (i % 3 == 2) REQUIRE(both.open_scene(without_instances) == OpenStatus::ok);
        const question asked = some_question(opened.blob, random);
        for (const Takes takes : {Takes::blob, Takes::scene, Takes::deformable}) both.compare(takes, asked);
        both.compare_moving(asked, random);
    }
}
