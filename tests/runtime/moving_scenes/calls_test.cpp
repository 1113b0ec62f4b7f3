// Claims about calls of moving scenes: which do not compile, and which instance the id of a result names.
#include "support/testing.hpp"

#include <runtime/moving_scenes/access.hpp>

#include "made_scene.hpp"

namespace espalier::tests::calls_test {
namespace {

template <class Scene, class Third>
constexpr bool takes_at_distance = requires(const Scene& scene, Third third) {
    closest_point(scene, Vec3{}, third);
};
template <class Scene>
constexpr bool takes_number_in_braces = requires(const Scene& scene) {
    instance_at(scene, {0u});
};

template <class Meshes, class Tiles>
constexpr bool makes = requires(std::span<std::byte> memory, Meshes&& meshes, Tiles&& tiles) {
    create_moving_scene(memory, 1u, 0, static_cast<Meshes&&>(meshes), static_cast<Tiles&&>(tiles));
    open_moving_scene(memory, static_cast<Meshes&&>(meshes), static_cast<Tiles&&>(tiles));
};
template <class Meshes>
constexpr bool makes_of_meshes = requires(std::span<std::byte> memory, Meshes&& meshes) {
    create_moving_scene(memory, 1u, 0, static_cast<Meshes&&>(meshes));
    open_moving_scene(memory, static_cast<Meshes&&>(meshes));
};
template <class Tiles>
constexpr bool makes_of_tiles = requires(std::span<std::byte> memory, Tiles&& tiles) {
    create_moving_scene(memory, 1u, 0, {}, static_cast<Tiles&&>(tiles));
    open_moving_scene(memory, {}, static_cast<Tiles&&>(tiles));
};

TEST_CASE("scene: a mask in the place of a distance does not compile") {
    static_assert(takes_at_distance<BakedScene, float> && takes_at_distance<MovingScene, float>);
    static_assert(!takes_at_distance<BakedScene, std::uint32_t> && !takes_at_distance<MovingScene, std::uint32_t>);
}

TEST_CASE("scene: a number in braces is no handle of a moving instance and does not compile") {
    static_assert(takes_number_in_braces<BakedScene> && !takes_number_in_braces<MovingScene>);
}

TEST_CASE("scene: a moving scene of arrays that end with the call does not compile") {
    using Meshes = std::vector<Blob>;
    using Tiles = std::vector<BakedScene>;
    static_assert(makes_of_meshes<Meshes&> && makes_of_meshes<const Meshes&>);
    static_assert(makes_of_meshes<std::span<Blob>> && makes_of_meshes<std::span<const Blob>>);
    static_assert(makes_of_meshes<std::array<Blob, 2>&> && makes_of_meshes<Blob(&)[2]>);
    static_assert(!makes_of_meshes<Meshes> && !makes_of_meshes<const Meshes>);
    static_assert(!makes_of_meshes<std::array<Blob, 2>>);
    static_assert(makes_of_tiles<Tiles&> && makes_of_tiles<std::span<const BakedScene>>);
    static_assert(!makes_of_tiles<Tiles>);
    static_assert(makes<Meshes&, Tiles&> && makes<std::span<Blob>, const Tiles&>);
    static_assert(!makes<Meshes&, Tiles> && !makes<Meshes, Tiles&> && !makes<Meshes, Tiles>);
}

TEST_CASE("scene: the id of a result names its instance in a moving scene and in a tile of it") {
    std::vector<Instance> row = row_of(2, 3.0f);
    row[1].user = 5;
    const SceneParts parts({make_cube(-0.5f, 0.5f)}, {row});
    MadeScene made(4, -12, parts.meshes, parts.tiles);
    MovingScene& scene = made.scene;
    CHECK(instance_at(MovingScene(), InstanceId{0}).status == QueryStatus::not_open);
    CHECK(instance_at(scene, InstanceId{0}).status == QueryStatus::out_of_range);
    for (std::uint32_t i = 0; i < 3; ++i) {
        Instance instance = {.transform = {}, .mesh = i == 1 ? 1u : 0u, .user = 10 + i};
        instance.transform.translation.y = 4.0f * static_cast<float>(i);
        REQUIRE(insert(scene, instance));
    }
    REQUIRE(remove(scene, *handle_of(scene, 2)) == QueryStatus::ok);
    CHECK(instance_at(scene, InstanceId{2}).status == QueryStatus::not_found);
    CHECK(instance_at(scene, InstanceId{3}).status == QueryStatus::out_of_range);
    CHECK(instance_at(scene, no_instance).status == QueryStatus::out_of_range);

    const Result<Instance> cube = instance_at(scene, InstanceId{0}), whole = instance_at(scene, InstanceId{1});
    REQUIRE(cube);
    REQUIRE(whole);
    CHECK(cube->user == 10);
    CHECK(cube->source == 0);
    CHECK(whole->user == 11);
    CHECK(whole->mesh == 1);
    CHECK(whole->source == 1);
    CHECK(instance_at(scene, InstanceId{0, 0}).status == QueryStatus::invalid_argument);
    CHECK(instance_at(scene, InstanceId{1, 2}).status == QueryStatus::invalid_argument);
    CHECK(instance_at(scene, InstanceId{2, 0}).status == QueryStatus::not_found);

    const InScene<RayHit> hit = raycast(scene, {.origin = {3.0f, 4.0f, 9.0f}, .direction = {0.0f, 0.0f, -1.0f}});
    REQUIRE(hit.instance.index == 1);
    const Result<Instance> inner = instance_at(scene, hit.instance);
    CHECK(inner->user == 5);
    CHECK(inner->transform.translation.x == 3.0f);
    CHECK(inner->source == instance_at(parts.tiles[0], InstanceId{hit.instance.in_tile})->source);
}

TEST_CASE("scene: changes and insertions that repack leave a scene that waits for a refit waiting") {
    const SceneParts parts({make_cube(-0.5f, 0.5f)});
    constexpr std::uint32_t capacity = 300;
    MadeScene made(capacity, -12, parts.meshes, {}, true);
    MovingScene& scene = made.scene;
    Random random(3);
    const auto place = [&] { return Instance{.transform = {{}, random.in_cube(50.0f)}}; };
    const Result<InstanceHandle> first = insert(scene, place()), second = insert(scene, place());
    REQUIRE(first);
    REQUIRE(second);
    const Box before = *box_of(scene, *first);
    Transform away;
    away.translation.x = 200.0f;
    const Movement movement = {*first, away};
    REQUIRE(move(scene, {&movement, 1}).status == QueryStatus::ok);
    CHECK(box_of(scene, *first)->min.x > before.max.x);

    const Ray ray = {.origin = {200.0f, 0.0f, 9.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    const auto still_waits = [&](const MovingScene& waiting) {
        return waiting.must_refit() && raycast(waiting, ray)->status == QueryStatus::not_refitted;
    };
    unsigned repacks = 0;
    while (scene.instance_count() < capacity) {
        const std::uint32_t nodes = detail::MovingSceneAccess::head(scene).nodes_used;
        REQUIRE(insert(scene, place()));
        repacks += detail::MovingSceneAccess::head(scene).nodes_used < nodes ? 1u : 0u;
        REQUIRE(still_waits(scene));
    }
    CHECK(repacks > 0);
    CHECK(remove(scene, *second) == QueryStatus::ok);
    CHECK(move(scene, *handle_of(scene, 2), away) == QueryStatus::ok);
    CHECK(still_waits(scene));
    const MadeScene copy(scene.bytes(), parts.meshes);
    CHECK(still_waits(copy.scene));
    refit(scene);
    CHECK(raycast(scene, ray));
    CHECK(handle_of(scene, 1).status == QueryStatus::not_found);
    CHECK(insert(scene, place())->slot == 1);
}

}  // namespace
}  // namespace espalier::tests::calls_test
