// Claims about c/scenes: changed and queried from C, a moving scene answers what it answers C++; and about its views,
// which C alone has.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include <c99.h>

#include "both.hpp"
#include "fixtures.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/aligned_buffer.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::uint32_t capacity = 20;

/// A scene of C over the meshes and tiles of a baked one.
struct SceneOfC {
    espalier_moving_scene scene;
    espalier_scene view;
    AlignedBuffer memory{static_cast<std::size_t>(c99_moving_scene_bytes(capacity))};
    std::size_t mesh_count = 0, tile_count = 0;
    const espalier_blob* meshes;
    const espalier_scene* tiles;
    espalier_instance_handle mesh, tile;

    explicit SceneOfC(const espalier_scene& baked)
        : meshes(c99_scene_meshes(&baked, &mesh_count)), tiles(c99_scene_tiles(&baked, &tile_count)) {
        const std::span<std::byte> bytes = memory.bytes();
        REQUIRE(c99_create_moving_scene(bytes.data(), bytes.size(), capacity, -16, meshes, mesh_count, tiles,
                                        tile_count, &scene));
        mesh = insert(0, 0.0f);
        tile = insert(static_cast<std::uint32_t>(mesh_count), 40.0f);
    }

    espalier_instance_handle insert(std::uint32_t number, float x) {
        const espalier_instance instance = {{{0, 0, 0, 1}, {x, 0, 0}, 1}, number, 1, 0, 0};
        const espalier_instance_handle_result handle = c99_moving_scene_insert(&scene, &instance);
        REQUIRE(handle.status == ESPALIER_QUERY_OK);
        return handle.value;
    }
    [[nodiscard]] Box box_of(espalier_instance_handle handle) const {
        return to<Box>(c99_moving_scene_box_of(&scene, handle).value);
    }
};

/// Checks that a scene is not open and refuses everything.
void check_empty(espalier_moving_scene scene) {
    const espalier_instance instance = {{{0, 0, 0, 1}, {0, 0, 0}, 1}, 0, 1, 0, 0};
    espalier_scene view;
    std::size_t size = 99, meshes = 99, tiles = 99;
    CHECK_FALSE(c99_moving_scene_is_open(&scene));
    CHECK_FALSE(c99_moving_scene_must_refit(&scene));
    CHECK(c99_moving_scene_capacity(&scene) == 0);
    CHECK(c99_moving_scene_slot_end(&scene) == 0);
    CHECK(c99_moving_scene_block(&scene, &size) == nullptr);
    CHECK(c99_moving_scene_meshes(&scene, &meshes) == nullptr);
    CHECK(c99_moving_scene_tiles(&scene, &tiles) == nullptr);
    CHECK(size + meshes + tiles == 0);
    CHECK(c99_moving_scene_insert(&scene, &instance).status == ESPALIER_QUERY_NOT_OPEN);
    CHECK(c99_moving_scene_remove(&scene, {0, 1}) == ESPALIER_QUERY_NOT_OPEN);
    CHECK(c99_moving_scene_move_instances_of(&scene, 0) == ESPALIER_QUERY_NOT_OPEN);
    CHECK(c99_moving_scene_refit(&scene) == 0);
    c99_moving_scene_repack(&scene);
    c99_moving_scene_end_step(&scene);
    std::memset(&view, 0xA5, sizeof view);
    CHECK(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_NOT_OPEN);
    CHECK(c99_scene_status(&view) == ESPALIER_OPEN_NOT_OPENED);
    CHECK(c99_scene_instance_count(&view) == 0);
    CHECK(c99_collect_candidate_pairs(&scene, nullptr, 0, nullptr, {0, 0}).status == ESPALIER_QUERY_NOT_OPEN);
}

/// Calls a function with each address that is no multiple of `alignment`; what it refuses, it does not write.
template <class T, class Call>
void check_misaligned(std::size_t alignment, Call call) {
    alignas(16) unsigned char room[2 * sizeof(T)];
    for (std::size_t offset = 1; offset < alignment; ++offset) {
        std::memset(room, 0xA5, sizeof room);
        CHECK(call(reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(room) + offset)));
        CHECK(std::all_of(std::begin(room), std::end(room), [](unsigned char byte) { return byte == 0xA5; }));
    }
}

}  // namespace

TEST_SUITE("moving scenes") {
    TEST_CASE("c api: changes and queries and pairs of a moving scene give the bits of C++") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both both;
        REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
        REQUIRE(both.create_moving_scene(capacity, -16));
        Random random(21);
        std::uint64_t hits = 0, refusals = 0, full = 0;
        const std::uint64_t rounds = scaled(400);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            both.compare_moving(some_question(both.scene(), random), random);
            const InScene<ClosestPoint> nearest = closest_point(both.moving(), {0.0f, 1.0f, 2.0f});
            hits += nearest ? 1u : 0u;
            refusals += nearest->status == QueryStatus::not_refitted ? 1u : 0u;
            full += both.moving().instance_count() + 1 >= capacity ? 1u : 0u;
        }
        if (!asks_enough()) return;
        CHECK(hits > rounds / 2);
        CHECK(refusals > rounds / 64);
        CHECK(full > rounds / 16);
        for (const Entry& entry : entries)
            if (entry.takes == Takes::moving || entry.takes == Takes::changes)
                CHECK_MESSAGE(both.answered.count(entry.name) == 1, std::string(entry.name));
    }

    TEST_CASE("c api: any bits are safe as a question about a moving scene") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Random random(23);
        for (const int step_exponent : {-100, -30, -16, 80}) {
            Both both;
            REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
            REQUIRE(both.create_moving_scene(12, step_exponent));
            for (std::uint64_t i = 0; i < scaled(200); ++i)
                both.compare_moving(any_bits<question>(random), random, random.coin());
        }
    }

    TEST_CASE("c api: a damaged snapshot opens as in C++ and gives the same bits") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both both;
        REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
        REQUIRE(both.create_moving_scene(12, -16));
        for (const Instance& instance : some_instances())
            if (both.moving().instance_count() < 9) CHECK(insert(both.moving(), instance));
        const std::vector<std::byte> snapshot(both.moving().bytes().begin(), both.moving().bytes().end());
        Random random(24);
        std::uint64_t opened = 0;
        const std::uint64_t rounds = scaled(500);
        for (std::uint64_t i = 0; i < rounds; ++i) {
            std::vector<std::byte> damaged = snapshot;
            const auto size = static_cast<std::uint32_t>(damaged.size());
            for (std::uint32_t changes = random.below(3); changes > 0; --changes)
                damaged[random.below(random.coin() ? 64 : size)] ^= static_cast<std::byte>(1 + random.below(255));
            if (random.below(8) == 0) damaged.resize(random.below(size));
            opened += both.open_moving_scene(damaged) ? 1u : 0u;
            both.compare_moving(some_question(both.scene(), random), random);
        }
        CHECK(opened > 0);
        CHECK(opened < rounds);
    }

    TEST_CASE("c api: a moving scene is created with enough aligned memory alone") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both baked;
        REQUIRE(baked.open_scene(bytes) == OpenStatus::ok);
        SceneOfC whole(baked.c->scene[0]);
        const auto least = static_cast<std::size_t>(c99_least_moving_scene_bytes(capacity));
        const std::uint32_t most = 1u << 24;
        AlignedBuffer memory(least + 16);
        std::byte* const block = memory.bytes().data();
        espalier_moving_scene scene = {};
        check_empty(scene);
        CHECK(c99_moving_scene_bytes(0) == 0);
        CHECK(c99_least_moving_scene_bytes(most + 1) == 0);
        CHECK(least > 0);
        CHECK(least <= c99_moving_scene_bytes(capacity));
        const struct {
            std::size_t offset, less;
            std::uint32_t capacity;
            int exponent;
        } refused[] = {{16, 0, capacity, -16}, {0, 1, capacity, -16},  {0, 0, 0, -16},
                       {0, 0, most + 1, -16},  {0, 0, capacity, -101}, {0, 0, capacity, 81}};
        for (const auto& r : refused) {
            std::memset(&scene, 0xA5, sizeof scene);
            CHECK_FALSE(c99_create_moving_scene(block + r.offset, least - r.less, r.capacity, r.exponent, whole.meshes,
                                                whole.mesh_count, nullptr, 0, &scene));
            check_empty(scene);
        }
        CHECK_FALSE(c99_create_moving_scene(nullptr, 0, capacity, 0, nullptr, 0, nullptr, 0, &scene));
        CHECK_FALSE(c99_open_moving_scene(nullptr, 0, nullptr, 0, nullptr, 0, &scene));
        check_misaligned<espalier_moving_scene>(sizeof(void*), [&](espalier_moving_scene* place) {
            return !c99_create_moving_scene(block, least, capacity, 0, whole.meshes, whole.mesh_count, nullptr, 0,
                                            place) &&
                   !c99_open_moving_scene(block, least, whole.meshes, whole.mesh_count, nullptr, 0, place);
        });
        for (const int exponent : {80, -100})
            CHECK(c99_create_moving_scene(block, least, capacity, exponent, nullptr, 0, nullptr, 0, &scene));
    }

    TEST_CASE("c api: a view of a moving scene takes queries and is no baked scene") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both baked;
        REQUIRE(baked.open_scene(bytes) == OpenStatus::ok);
        SceneOfC of_c(baked.c->scene[0]);
        espalier_moving_scene &scene = of_c.scene, other;
        espalier_scene& view = of_c.view;
        REQUIRE(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_OK);
        for (const espalier_instance_id id :
             {espalier_instance_id{0, ESPALIER_NO_INSTANCE}, {0, 0}, {1, 0}, {99, 99}}) {
            CHECK(c99_scene_instance_at(&view, id).status == ESPALIER_QUERY_INVALID_ARGUMENT);
            CHECK(c99_scene_mesh_at(&view, id).status == ESPALIER_QUERY_INVALID_ARGUMENT);
            CHECK(c99_scene_is_on_common_lattice(&view, id).status == ESPALIER_QUERY_INVALID_ARGUMENT);
        }
        CHECK(c99_scene_common_lattice(&view).status == ESPALIER_QUERY_NOT_FOUND);
        CHECK(c99_scene_size(&view) == 0);
        CHECK(std::isinf(c99_scene_max_error(&view)));
        CHECK(c99_scene_instance_count(&view) == c99_moving_scene_instance_count(&scene));
        std::size_t count = 0;
        CHECK(c99_scene_meshes(&view, &count) == c99_moving_scene_meshes(&scene, &count));
        CHECK(c99_scene_tiles(&view, &count) == c99_moving_scene_tiles(&scene, &count));
        const Box bounds = to<Box>(c99_scene_bounds(&view)), mesh = of_c.box_of(of_c.mesh),
                  tile = of_c.box_of(of_c.tile);
        for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            CHECK(bounds.min.*axis <= std::min(mesh.min.*axis, tile.min.*axis));
            CHECK(bounds.max.*axis >= std::max(mesh.max.*axis, tile.max.*axis));
        }

        espalier_baked_pair pair;
        espalier_filled_baked_pairs page =
            c99_collect_candidate_pairs_with_baked(&scene, &view, &pair, 1, nullptr, {1, {2, 3}});
        CHECK(page.status == ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(page.count == 0);
        CHECK(page.next.moving == 1);
        CHECK(page.next.baked.index == 2);
        CHECK(page.next.baked.in_tile == 3);
        page = c99_collect_colliding_pairs_with_baked(&scene, &view, &pair, 1, 99, nullptr, {0, {0, 0}});
        CHECK(page.status == ESPALIER_QUERY_INVALID_ARGUMENT);
        page = c99_collect_colliding_pairs_with_baked(&scene, of_c.tiles, nullptr, 0, 99, nullptr, {0, {0, 0}});
        CHECK(page.status != ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(page.count == 0);

        const espalier_scene tiles[] = {*of_c.tiles, view};
        AlignedBuffer memory(10'000);
        std::byte* const block = memory.bytes().data();
        CHECK(c99_create_moving_scene(block, 10'000, capacity, 0, nullptr, 0, tiles, 1, &other));
        CHECK_FALSE(c99_create_moving_scene(block, 10'000, capacity, 0, nullptr, 0, tiles, 2, &other));
        check_empty(other);
        CHECK_FALSE(c99_open_moving_scene(block, 10'000, nullptr, 0, tiles, 2, &other));
        check_misaligned<espalier_scene>(16, [&](espalier_scene* place) {
            return c99_moving_scene_view(&scene, place) == ESPALIER_QUERY_INVALID_ARGUMENT;
        });
    }

    TEST_CASE("c api: a view of a moving scene that waits for a refit is refused like the scene") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both baked;
        REQUIRE(baked.open_scene(bytes) == OpenStatus::ok);
        SceneOfC of_c(baked.c->scene[0]);
        espalier_moving_scene &scene = of_c.scene, other;
        espalier_scene& view = of_c.view;
        AlignedBuffer memory(10'000);
        const espalier_movement movement = {of_c.tile, {{0, 0, 0, 1}, {1, 2, 3}, 1}};
        CHECK(c99_moving_scene_move_batch(&scene, nullptr, 0).status == ESPALIER_QUERY_OK);
        CHECK_FALSE(c99_moving_scene_must_refit(&scene));
        CHECK(c99_moving_scene_move_batch(&scene, &movement, 1).count == 1);
        CHECK(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_NOT_REFITTED);
        CHECK(c99_scene_closest_point(&view, {0, 0, 0}, 9, UINT32_MAX).hit.status == ESPALIER_QUERY_NOT_REFITTED);
        CHECK(c99_scene_status(&view) == ESPALIER_OPEN_NOT_OPENED);
        CHECK(c99_scene_instance_count(&view) == 0);
        CHECK(c99_collect_candidate_pairs(&scene, nullptr, 0, nullptr, {0, 0}).status == ESPALIER_QUERY_NOT_REFITTED);
        CHECK_FALSE(c99_create_moving_scene(memory.bytes().data(), 10'000, capacity, 0, nullptr, 0, &view, 1, &other));
        c99_moving_scene_refit(&scene);
        CHECK(c99_collect_candidate_pairs_with_baked(&scene, &view, nullptr, 0, nullptr, {0, {0, 0}}).status ==
              ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(c99_moving_scene_view(&scene, &view) == ESPALIER_QUERY_OK);
    }

    TEST_CASE("c api: a copy of the block of a moving scene goes on like the block") {
        const std::vector<std::byte> bytes = bake_instances(some_instances());
        Both baked;
        REQUIRE(baked.open_scene(bytes) == OpenStatus::ok);
        SceneOfC of_c(baked.c->scene[0]);
        const espalier_transform place = {{0, 0, 0, 1}, {3, 2, 1}, 1};
        espalier_moving_scene continued;
        std::size_t size = 0, other_size = 0;
        const auto* const block = static_cast<const std::byte*>(c99_moving_scene_block(&of_c.scene, &size));
        REQUIRE(size > 0);
        AlignedBuffer memory(std::span(block, size));
        std::byte* const copy = memory.bytes().data();
        const auto open_copy = [&](std::size_t bytes_given) {
            return c99_open_moving_scene(copy, bytes_given, of_c.meshes, of_c.mesh_count, of_c.tiles, of_c.tile_count,
                                         &continued);
        };
        REQUIRE(open_copy(size));
        CHECK(c99_moving_scene_move(&continued, of_c.tile, &place) == ESPALIER_QUERY_OK);
        CHECK(std::memcmp(copy, block, size) != 0);
        CHECK(c99_moving_scene_move(&of_c.scene, of_c.tile, &place) == ESPALIER_QUERY_OK);
        CHECK(c99_moving_scene_block(&continued, &other_size) == copy);
        CHECK(other_size == size);
        CHECK(std::memcmp(copy, block, size) == 0);
        CHECK_FALSE(open_copy(size - 1));
        check_empty(continued);
        copy[0] ^= std::byte{1};
        CHECK_FALSE(open_copy(size));
    }
}
