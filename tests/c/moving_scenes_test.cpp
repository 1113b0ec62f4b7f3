// Claims about c/scenes: changed and queried from C, a moving scene answers what it answers C++; and about its views,
// which C alone has.
#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <c99.h>

#include "both.hpp"
#include "fixtures.hpp"
#include "room.hpp"
#include "support/base/test_scale.hpp"
#include "support/machine/aligned_buffer.hpp"

using namespace espalier;
using namespace espalier::tests;

namespace {

constexpr std::uint32_t capacity = 20;

std::size_t bytes_of(std::uint32_t instances) { return static_cast<std::size_t>(moving_scene_bytes(instances)); }

}  // namespace

TEST_CASE("c api: changes and queries and pairs of a moving scene give the bits of C++") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Both both;
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    // The step of a mesh, so that some instances lie on the common lattice.
    const int step_exponent = both.scene().meshes()[0].lattice().step_exponent;
    REQUIRE(both.create_moving_scene(capacity, step_exponent, bytes_of(capacity)));
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

TEST_CASE("c api: a view of a moving scene from a place in its world gives the bits of C++") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Random random(22);
    Both both;
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    REQUIRE(both.create_moving_scene(capacity, -16, bytes_of(capacity)));
    std::uint64_t views = 0;
    for (std::uint64_t i = 0; i < scaled(200); ++i) {
        const auto coordinate = [&] { return std::ldexp(double{random.signed_unit()}, random.between(-20, 17)); };
        const Vec3d place = {coordinate(), coordinate(), coordinate()};
        espalier_moving_scene view = both.c->moving_scene[0];
        const MovingScene expected = seen_from(both.moving(), place);
        const bool is_open = c99_moving_scene_seen_from(&both.c->moving_scene[0], {place.x, place.y, place.z}, &view);
        REQUIRE(is_open == static_cast<bool>(expected));
        REQUIRE(is_open == c99_moving_scene_is_open(&view));
        if (!is_open) continue;
        ++views;
        const espalier_vec3d origin = c99_moving_scene_origin(&view);
        REQUIRE(Vec3d{origin.x, origin.y, origin.z} == expected.origin());
        both.c->moving_scene[0] = view;
        both.moving() = expected;
        both.compare_moving(some_question(both.scene(), random), random);
    }
    if (asks_enough()) CHECK(views > scaled(100));
    // Memory that a scene cannot lie in.
    alignas(espalier_moving_scene) unsigned char room[sizeof(espalier_moving_scene) + 1] = {};
    CHECK_FALSE(
        c99_moving_scene_seen_from(&both.c->moving_scene[0], {}, reinterpret_cast<espalier_moving_scene*>(room + 1)));
    for (const unsigned char byte : room) CHECK(byte == 0);
    espalier_moving_scene empty = {};
    CHECK_FALSE(c99_moving_scene_seen_from(&empty, {}, &both.c->moving_scene[0]));
    CHECK_FALSE(c99_moving_scene_is_open(&both.c->moving_scene[0]));
}

TEST_CASE("c api: any bits are safe as a question about a moving scene") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Random random(23);
    for (const int step_exponent : {-100, -30, -16, 80}) {
        Both both;
        REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
        REQUIRE(both.create_moving_scene(12, step_exponent, bytes_of(12)));
        for (std::uint64_t i = 0; i < scaled(200); ++i)
            both.compare_moving(any_bits<question>(random), random, random.coin());
    }
}

TEST_CASE("c api: a damaged snapshot opens as in C++ and gives the same bits") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Both both;
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    REQUIRE(both.create_moving_scene(12, -16, bytes_of(12)));
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
    const auto least = static_cast<std::size_t>(least_moving_scene_bytes(capacity));
    const std::uint32_t most = 1u << 24;
    const struct {
        std::size_t offset, less;
        std::uint32_t capacity;
        int exponent;
        bool is_open;
    } cases[] = {{0, 0, capacity, 80, true},    {0, 0, capacity, -100, true}, {16, 0, capacity, -16, false},
                 {0, 1, capacity, -16, false},  {0, 0, 0, -16, false},        {0, 0, most + 1, -16, false},
                 {0, 0, capacity, -101, false}, {0, 0, capacity, 81, false}};
    Random random(26);
    for (const auto& made : cases) {
        Both both;
        REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
        std::memset(&both.c->moving_scene[0], 0xA5, sizeof(espalier_moving_scene));
        CHECK(both.create_moving_scene(made.capacity, made.exponent, least - made.less, made.offset) == made.is_open);
        both.compare_moving(some_question(both.scene(), random), random);
    }
    espalier_moving_scene scene;
    AlignedBuffer memory(least);
    std::byte* const block = memory.bytes().data();
    CHECK_FALSE(c99_create_moving_scene(nullptr, 0, capacity, 0, nullptr, 0, nullptr, 0, &scene));
    CHECK_FALSE(c99_open_moving_scene(nullptr, 0, nullptr, 0, nullptr, 0, &scene));
    check_misaligned<espalier_moving_scene>(sizeof(void*), [&](espalier_moving_scene* place) {
        return !c99_create_moving_scene(block, least, capacity, 0, nullptr, 0, nullptr, 0, place) &&
               !c99_open_moving_scene(block, least, nullptr, 0, nullptr, 0, place);
    });
}

TEST_CASE("c api: a view of a moving scene takes queries and is no baked scene") {
    const std::vector<std::byte> bytes = bake_instances(some_instances());
    Both both;
    REQUIRE(both.open_scene(bytes) == OpenStatus::ok);
    REQUIRE(both.create_moving_scene(capacity, -16, bytes_of(capacity)));
    Random random(25);
    const question asked = some_question(both.scene(), random);
    both.change(asked, random);
    const espalier_scene baked = both.c->scene[0];
    espalier_moving_scene &scene = both.c->moving_scene[0], other;
    AlignedBuffer memory(10'000);
    std::byte* const block = memory.bytes().data();
    for (const bool waits : {false, true}) {
        const espalier_movement movement = {c99_moving_scene_handle_of(&scene, 0).value, c99_identity()};
        if (waits) REQUIRE(c99_moving_scene_move_batch(&scene, &movement, 1).count == 1);
        else c99_moving_scene_refit(&scene);
        espalier_scene view;
        REQUIRE(c99_moving_scene_view(&scene, &view) == (waits ? ESPALIER_QUERY_NOT_REFITTED : ESPALIER_QUERY_OK));
        CHECK(c99_scene_instance_count(&view) == (waits ? 0 : c99_moving_scene_instance_count(&scene)));
        CHECK(std::isinf(c99_scene_max_error(&view)));
        CHECK(c99_scene_size(&view) == 0);
        const int refusal = waits ? ESPALIER_QUERY_NOT_OPEN : ESPALIER_QUERY_INVALID_ARGUMENT;
        const espalier_lattice_result common = c99_scene_common_lattice(&view);
        const espalier_lattice_result expected = c99_moving_scene_common_lattice(&scene);
        CHECK(common.status == (waits ? int{ESPALIER_QUERY_NOT_REFITTED} : int{expected.status}));
        CHECK((waits || std::memcmp(&common.value, &expected.value, sizeof common.value) == 0));
        for (const espalier_instance_id id :
             {espalier_instance_id{0, ESPALIER_NO_INSTANCE}, {0, 0}, {1, 0}, {99, 99}}) {
            CHECK(c99_scene_instance_at(&view, id).status == refusal);
            CHECK(c99_scene_mesh_at(&view, id).status == refusal);
            CHECK(c99_scene_is_on_common_lattice(&view, id).status == refusal);
        }
        std::size_t count = 0;
        CHECK((c99_scene_meshes(&view, &count) == c99_moving_scene_meshes(&scene, &count)) != waits);
        CHECK((c99_scene_tiles(&view, &count) == c99_moving_scene_tiles(&scene, &count)) != waits);
        const espalier_box bounds = c99_scene_bounds(&view);
        for (std::uint32_t slot = 0; !waits && slot < c99_moving_scene_slot_end(&scene); ++slot) {
            const espalier_instance_handle handle = c99_moving_scene_handle_of(&scene, slot).value;
            const espalier_box_result box = c99_moving_scene_box_of(&scene, handle);
            if (box.status != ESPALIER_QUERY_OK) continue;
            for (const auto axis : {&espalier_vec3::x, &espalier_vec3::y, &espalier_vec3::z}) {
                CHECK(bounds.min.*axis <= box.value.min.*axis);
                CHECK(bounds.max.*axis >= box.value.max.*axis);
            }
        }
        espalier_filled_baked_pairs page =
            c99_collect_candidate_pairs_with_baked(&scene, &view, nullptr, 0, nullptr, {1, {2, 3}});
        CHECK(page.status == ESPALIER_QUERY_INVALID_ARGUMENT);
        CHECK(page.count == 0);
        CHECK(page.next.moving == 1);
        CHECK(page.next.baked.index == 2);
        CHECK(page.next.baked.in_tile == 3);
        page = c99_collect_colliding_pairs_with_baked(&scene, &view, nullptr, 0, 99, nullptr, {0, {0, 0}});
        CHECK(page.status == ESPALIER_QUERY_INVALID_ARGUMENT);
        const espalier_scene tiles[] = {baked, view};
        for (const std::size_t given : {1u, 2u})
            CHECK(c99_create_moving_scene(block, 10'000, capacity, 0, nullptr, 0, tiles, given, &other) ==
                  (given == 1));
        CHECK_FALSE(c99_moving_scene_is_open(&other));
        CHECK_FALSE(c99_open_moving_scene(block, 10'000, nullptr, 0, tiles, 2, &other));
    }
    check_misaligned<espalier_scene>(16, [&](espalier_scene* place) {
        return c99_moving_scene_view(&scene, place) == ESPALIER_QUERY_INVALID_ARGUMENT;
    });
}
