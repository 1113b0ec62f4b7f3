// Claims about moving scenes: what each call changes and refuses, and what a snapshot continues with.
#include "support/testing.hpp"

#include "made_scene.hpp"

namespace espalier::tests::moving_scenes_scene_test {
namespace {

/// Two meshes, an empty one, and two tiles of which one is empty.
const SceneParts& parts() {
    static const SceneParts all({make_cube(-0.5f, 0.5f), make_torus(12, 8, 1.0, 0.25), Mesh{}},
                                {row_of(3, 2.0f), std::vector<Instance>{}});
    return all;
}

constexpr int step_exponent = -12;

Instance instance_at_place(const Vec3& translation, std::uint32_t mesh = 0) {
    return {.transform = {{}, translation}, .mesh = mesh};
}

Transform random_transform(Random& random) {
    return {{random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.5f},
            random.in_cube(8.0f),
            std::ldexp(1.0f + random.unit(), random.between(-3, 1))};
}

/// What a moving scene must hold: instances by slot, and the handles that are stale.
struct Model {
    std::map<std::uint32_t, Instance> live;
    std::vector<InstanceHandle> handles, stale;

    void forget(std::size_t number) {
        live.erase(handles[number].slot);
        stale.push_back(handles[number]);
        handles[number] = handles.back();
        handles.pop_back();
    }
    /// Checks every fact that the scene returns of itself.
    void check(const MovingScene& scene) const {
        REQUIRE(scene.instance_count() == live.size());
        std::uint32_t found = 0;
        for (std::uint32_t slot = 0; slot < scene.slot_end(); ++slot) {
            const Result<InstanceHandle> handle = handle_of(scene, slot);
            const auto at = live.find(slot);
            if (at == live.end()) {
                REQUIRE(handle.status == QueryStatus::not_found);
                continue;
            }
            ++found;
            const Result<Instance> instance = instance_at(scene, *handle);
            REQUIRE(instance);
            REQUIRE(instance->transform == at->second.transform);
            REQUIRE(instance->mesh == at->second.mesh);
            REQUIRE(instance->mask == at->second.mask);
            REQUIRE(instance->user == at->second.user);
            REQUIRE(instance->source == slot);
        }
        REQUIRE(found == live.size());
        for (const InstanceHandle& handle : stale)
            REQUIRE(instance_at(scene, handle).status == QueryStatus::stale_handle);
    }
};

/// A scene and its model, which random calls change alike.
struct Trial {
    MadeScene made;
    Model model;
    Random random;

    Trial(std::uint32_t capacity, bool is_least, std::uint64_t seed)
        : made(capacity, step_exponent, parts().meshes, parts().tiles, is_least), random(seed) {}

    void insert_any() {
        MovingScene& scene = made.scene;
        Instance instance = {.transform = random_transform(random),
                             .mesh = random.below(8) == 0 ? 3 : random.below(2),
                             .mask = 1u << random.below(4),
                             .user = random.below(1000)};
        const Result<InstanceHandle> handle = insert(scene, instance);
        if (model.live.size() == scene.capacity()) {
            REQUIRE(handle.status == QueryStatus::no_room);
            return;
        }
        REQUIRE(handle);
        REQUIRE(model.live.emplace(handle->slot, instance).second);
        model.handles.push_back(*handle);
    }
    void remove_any() {
        const std::size_t number = any();
        REQUIRE(remove(made.scene, model.handles[number]) == QueryStatus::ok);
        REQUIRE(remove(made.scene, model.handles[number]) == QueryStatus::stale_handle);
        model.forget(number);
    }
    void move_any() {
        const InstanceHandle handle = model.handles[any()];
        const Transform transform = random_transform(random);
        REQUIRE(move(made.scene, handle, transform) == QueryStatus::ok);
        model.live[handle.slot].transform = transform;
    }
    void move_some() {
        std::vector<Movement> movements;
        for (std::uint32_t count = random.below(10); count > 0; --count) {
            const InstanceHandle handle = model.handles[any()];
            movements.push_back({handle, random_transform(random)});
            model.live[handle.slot].transform = movements.back().transform;
        }
        // One in the middle that is refused ends a batch; what is left of it is the next one.
        const std::size_t bad = random.below(static_cast<std::uint32_t>(movements.size()) + 1);
        std::vector<Movement> first(movements.begin(), movements.begin() + static_cast<std::ptrdiff_t>(bad));
        first.push_back({{1000, 1}, {}});
        first.push_back({model.handles[any()], random_transform(random)});
        const Filled begun = move(made.scene, first);
        REQUIRE(begun.status == QueryStatus::stale_handle);
        REQUIRE(begun.count == bad);
        const Filled ended = move(made.scene, std::span(movements).subspan(bad));
        REQUIRE(ended.status == QueryStatus::ok);
        REQUIRE(ended.count == movements.size() - bad);
        REQUIRE((movements.empty() || made.scene.must_refit()));
    }
    void operate() {
        const std::uint32_t what = random.below(100);
        if (what < 40 || model.handles.empty()) return insert_any();
        if (what < 70) return remove_any();
        if (what < 85) return move_any();
        if (what < 90) return move_some();
        if (what < 92) return repack(made.scene);
        if (what < 95) {
            const InstanceHandle handle = model.handles[any()];
            REQUIRE(set_mask(made.scene, handle, what) == QueryStatus::ok);
            REQUIRE(set_user(made.scene, handle, 7 * what) == QueryStatus::ok);
            model.live[handle.slot].mask = what;
            model.live[handle.slot].user = 7 * what;
            return;
        }
        if (what < 97) return end_step(made.scene);
        (void)refit(made.scene);
        REQUIRE_FALSE(made.scene.must_refit());
    }
    std::size_t any() { return random.below(static_cast<std::uint32_t>(model.handles.size())); }
};

TEST_CASE("scene: random changes leave a moving scene as a list of instances has it and open to a snapshot") {
    for (const bool is_least : {false, true})
        for (const std::uint32_t capacity : {1u, 8u, 64u, 300u}) {
            CAPTURE(is_least);
            CAPTURE(capacity);
            Trial trial(capacity, is_least, 1);
            REQUIRE(trial.made.scene);
            for (std::uint64_t i = 0; i < scaled(1'000); ++i) {
                CAPTURE(i);
                trial.operate();
                trial.model.check(trial.made.scene);
                const MadeScene copy(trial.made.scene.bytes(), parts().meshes, parts().tiles);
                REQUIRE(copy.scene);
            }
        }
}

TEST_CASE("scene: a moving scene makes all room that it states in the fewest bytes too") {
    for (const bool is_least : {false, true})
        for (std::uint32_t capacity = 1; capacity < 400; capacity += 1 + capacity / 7) {
            CAPTURE(capacity);
            MadeScene made(capacity, step_exponent, parts().meshes, {}, is_least);
            REQUIRE(made.scene);
            Random random(capacity);
            for (std::uint32_t i = 0; i < capacity; ++i) {
                Instance instance = {.transform = {{}, random.in_cube(50.0f)}};
                REQUIRE(insert(made.scene, instance));
            }
            CHECK(insert(made.scene, {}).status == QueryStatus::no_room);
            CHECK(open_moving_scene(made.bytes(), parts().meshes));
        }
}

TEST_CASE("scene: memory that does not fit makes no moving scene") {
    const std::uint64_t least = least_moving_scene_bytes(10);
    CHECK(least < moving_scene_bytes(10));
    std::vector<std::byte> memory(static_cast<std::size_t>(least) + 64);
    const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
    const std::span<std::byte> aligned =
        std::span(memory).subspan((32 - address % 32) % 32).first(static_cast<std::size_t>(least));
    CHECK(create_moving_scene(aligned, 10, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned.first(aligned.size() - 1), 10, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned.subspan(4), 5, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned, 0, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned, 11, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned, 0xFFFFFFFF, 0, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned, 10, -101, parts().meshes));
    CHECK_FALSE(create_moving_scene(aligned, 10, 81, parts().meshes));
    CHECK_FALSE(create_moving_scene({}, 10, 0, parts().meshes));
    CHECK(create_moving_scene(aligned, 10, 80, {}));
    CHECK(moving_scene_bytes(0) == 0);
    CHECK(moving_scene_bytes((1u << 24) + 1) == 0);
    CHECK(least_moving_scene_bytes((1u << 24) + 1) == 0);
    CHECK(moving_scene_bytes(1u << 24) < 174ull << 24);
    CHECK(least_moving_scene_bytes(1u << 24) < 138ull << 24);
    CHECK(least_moving_scene_bytes(64) <= 9216);
}

TEST_CASE("scene: a scene that was never made refuses every call") {
    MovingScene none;
    CHECK_FALSE(none);
    CHECK(none.bytes().empty());
    CHECK(none.capacity() == 0);
    CHECK(none.slot_end() == 0);
    CHECK(none.step_exponent() == 0);
    CHECK_FALSE(none.must_refit());
    CHECK(insert(none, {}).status == QueryStatus::not_open);
    CHECK(remove(none, {}) == QueryStatus::not_open);
    CHECK(move(none, {}, Transform{}) == QueryStatus::not_open);
    CHECK(move(none, std::span<const Movement>{}).status == QueryStatus::not_open);
    CHECK(set_mask(none, {}, 1) == QueryStatus::not_open);
    CHECK(set_user(none, {}, 1) == QueryStatus::not_open);
    CHECK(refit(none) == 0);
    repack(none);
    end_step(none);
    CHECK(quality(none) == 1.0f);
    CHECK(handle_of(none, 0).status == QueryStatus::not_open);
    CHECK(instance_at(none, InstanceHandle{}).status == QueryStatus::not_open);
    CHECK(box_of(none, {}).status == QueryStatus::not_open);
    CHECK(raycast(none, Ray{}).hit.status == QueryStatus::not_open);
    CHECK(closest_point(none, {}).hit.status == QueryStatus::not_open);
    CHECK(overlaps(none, Sphere{}).status() == QueryStatus::not_open);
    std::vector<InstancePair> pairs(1);
    CHECK(collect_candidate_pairs(none, pairs).status == QueryStatus::not_open);
    CHECK(collect_colliding_pairs(none, pairs, WorkLimit::unlimited()).status == QueryStatus::not_open);
}

TEST_CASE("scene: bad instances and places are refused and change nothing") {
    MadeScene made(4, step_exponent, parts().meshes, parts().tiles);
    MovingScene& scene = made.scene;
    const InstanceHandle handle = *insert(scene, instance_at_place({1.0f, 2.0f, 3.0f}));
    const std::vector<std::byte> before = snapshot_of(scene);
    const float end = std::ldexp(1.0f, 30 + step_exponent);
    for (const std::uint32_t mesh : {2u, 4u, 5u, 0xFFFFFFFFu})
        CHECK(insert(scene, instance_at_place({}, mesh)).status == QueryStatus::invalid_argument);
    const auto refuses = [&](const Transform& transform, QueryStatus status) {
        Instance instance = {.transform = transform};
        CHECK(insert(scene, instance).status == status);
        CHECK(move(scene, handle, transform) == status);
        const Movement movements[] = {{handle, transform}};
        CHECK(move(scene, movements).status == status);
    };
    for (const float bad : {not_a_number, infinity, -infinity}) {
        refuses({{}, {bad, 0.0f, 0.0f}, 1.0f}, QueryStatus::invalid_argument);
        refuses({{0.0f, bad, 0.0f, 1.0f}, {}, 1.0f}, QueryStatus::invalid_argument);
        refuses({{}, {}, bad}, QueryStatus::invalid_argument);
    }
    for (const float scale : {0.0f, -1.0f, 0x1p-120f, 0x1p101f})
        refuses({{}, {}, scale}, QueryStatus::invalid_argument);
    refuses({{0.0f, 0.0f, 0.0f, 0.0f}, {}, 1.0f}, QueryStatus::invalid_argument);
    for (const float x : {end, -end, 1e30f}) refuses({{}, {0.0f, x, 0.0f}, 1.0f}, QueryStatus::out_of_range);
    refuses({{}, {}, 1e20f}, QueryStatus::out_of_range);
    CHECK(snapshot_of(scene) == before);
    CHECK(insert(scene, instance_at_place({0.0f, end - 2.0f, 0.0f}, 3)));
}

TEST_CASE("scene: stale and random handles are refused and change nothing") {
    MadeScene made(8, step_exponent, parts().meshes);
    MovingScene& scene = made.scene;
    Random random(4);
    const InstanceHandle kept = *insert(scene, {});
    const InstanceHandle old = *insert(scene, {});
    REQUIRE(remove(scene, old) == QueryStatus::ok);
    const InstanceHandle again = *insert(scene, {});
    CHECK(again.slot == old.slot);
    CHECK(again != old);
    const std::vector<std::byte> before = snapshot_of(scene);
    const auto refuses = [&](InstanceHandle handle) {
        CHECK(remove(scene, handle) == QueryStatus::stale_handle);
        CHECK(move(scene, handle, Transform{}) == QueryStatus::stale_handle);
        CHECK(set_mask(scene, handle, 5) == QueryStatus::stale_handle);
        CHECK(set_user(scene, handle, 5) == QueryStatus::stale_handle);
        CHECK(instance_at(scene, handle).status == QueryStatus::stale_handle);
        CHECK(box_of(scene, handle).status == QueryStatus::stale_handle);
    };
    refuses(old);
    refuses({});
    refuses({kept.slot, kept.generation + 1});
    refuses({2, 0});
    refuses({7, 1});
    for (int i = 0; i < 1'000; ++i) {
        const auto any = [&] { return static_cast<std::uint32_t>(random.next()); };
        const InstanceHandle handle = {random.coin() ? random.below(10) : any(),
                                       random.coin() ? random.below(4) : any()};
        if (handle != kept && handle != again) refuses(handle);
    }
    CHECK(snapshot_of(scene) == before);
    CHECK(handle_of(scene, 2).status == QueryStatus::out_of_range);
}

TEST_CASE("scene: queries wait for a refit after a batch of moves and see its places then") {
    MadeScene made(4, step_exponent, parts().meshes);
    MovingScene& scene = made.scene;
    const InstanceHandle handle = *insert(scene, instance_at_place({0.0f, 0.0f, 0.0f}));
    (void)*insert(scene, instance_at_place({0.0f, 9.0f, 0.0f}));
    const Ray ray = {{5.0f, 0.0f, -3.0f}, {0.0f, 0.0f, 1.0f}};
    CHECK_FALSE(raycast(scene, ray));
    Movement movements[] = {{handle, {}}};
    movements[0].transform.translation.x = 5.0f;
    CHECK(move(scene, movements).count == 1);
    std::vector<InstancePair> pairs(4);
    std::vector<Ray> rays(1);
    std::vector<InScene<RayHit>> hits(1);
    const auto none = [](auto...) {};
    CHECK(raycast(scene, ray).hit.status == QueryStatus::not_refitted);
    CHECK(raycast(scene, rays, hits).status == QueryStatus::not_refitted);
    CHECK(occluded(scene, ray).status() == QueryStatus::not_refitted);
    CHECK(for_each_hit(scene, ray, [](InstanceId, const RayHit&) {}) == QueryStatus::not_refitted);
    CHECK(closest_point(scene, {}).hit.status == QueryStatus::not_refitted);
    CHECK(sweep(scene, Sphere{}, {}).hit.status == QueryStatus::not_refitted);
    CHECK(overlaps(scene, Sphere{}).status() == QueryStatus::not_refitted);
    CHECK(for_each_overlap(scene, Sphere{}, none) == QueryStatus::not_refitted);
    CHECK(for_each_candidate(scene, Box{}, [](InstanceId) {}) == QueryStatus::not_refitted);
    CHECK(collect_candidate_pairs(scene, pairs).status == QueryStatus::not_refitted);
    CHECK(collect_colliding_pairs(scene, pairs, WorkLimit::unlimited()).status == QueryStatus::not_refitted);
    CHECK(SceneView(scene).common_lattice().status == QueryStatus::not_refitted);
    CHECK(refit(scene) == 0);  // the root is the only node
    const InScene<RayHit> hit = raycast(scene, ray);
    CHECK(hit.instance == InstanceId{handle.slot});
    CHECK(hit->t == 2.5f);
}

TEST_CASE("scene: a view that outlives the last instance finds nothing") {
    MadeScene made(4, step_exponent, parts().meshes, parts().tiles);
    const Result<InstanceHandle> only = insert(made.scene, instance_at_place({}));
    REQUIRE(only);
    const SceneView view = made.scene;
    const Ray ray = {.origin = {0.0f, 0.0f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    REQUIRE(raycast(view, ray));
    REQUIRE(remove(made.scene, *only) == QueryStatus::ok);
    CHECK_FALSE(raycast(view, ray));
    CHECK_FALSE(occluded(view, ray).yes());
    CHECK_FALSE(closest_point(view, Vec3{}));
    CHECK_FALSE(overlaps(view, Sphere{{}, 1.0f}).yes());
}

TEST_CASE("scene: quality rises as instances move away from their neighbours and is one after a repack") {
    MadeScene made(500, step_exponent, parts().meshes);
    MovingScene& scene = made.scene;
    Random random(6);
    std::vector<Movement> movements;
    for (int i = 0; i < 500; ++i) {
        movements.push_back({*insert(scene, instance_at_place(random.in_cube(40.0f))), {}});
    }
    CHECK(quality(scene) == infinity);
    repack(scene);
    CHECK(quality(scene) == 1.0f);
    for (Movement& movement : movements) movement.transform.translation = random.in_cube(40.0f);
    REQUIRE(move(scene, movements).count == 500);
    CHECK(refit(scene) > 60);
    CHECK(quality(scene) > 2.0f);
    repack(scene);
    CHECK(quality(scene) == 1.0f);
}

TEST_CASE("scene: the box of an instance is that of its mesh and a little more") {
    MadeScene made(2, step_exponent, parts().meshes);
    MovingScene& scene = made.scene;
    const InstanceHandle handle = *insert(scene, instance_at_place({100.0f, -7.0f, 0.25f}));
    const Box box = *box_of(scene, handle);
    CHECK(box.min.x < 99.5f);
    CHECK(box.min.x > 99.49f);
    CHECK(box.max.x > 100.5f);
    CHECK(box.max.x < 100.51f);
    CHECK(box.min.y < -7.5f);
    CHECK(box.max.z > 0.75f);
}

TEST_CASE("scene: a snapshot continues with the same bytes as the scene") {
    Trial trial(100, false, 8);
    for (int i = 0; i < 400; ++i) trial.operate();
    Trial copy(100, false, 9);
    std::memcpy(copy.made.bytes().data(), trial.made.bytes().data(), trial.made.bytes().size());
    copy.made.scene = open_moving_scene(copy.made.bytes(), parts().meshes, parts().tiles);
    REQUIRE(copy.made.scene);
    copy.model = trial.model;
    trial.random = copy.random;
    for (int i = 0; i < 400; ++i) {
        trial.operate();
        copy.operate();
    }
    CHECK(snapshot_of(trial.made.scene) == snapshot_of(copy.made.scene));
}

TEST_CASE("scene: one batch or several slices of it leave the same bytes") {
    const auto bytes_after = [](std::size_t slices) {
        Trial trial(200, false, 10);
        for (int i = 0; i < 150; ++i) trial.insert_any();
        for (int round = 0; round < 20; ++round) {
            std::vector<Movement> movements;
            for (const InstanceHandle& handle : trial.model.handles)
                movements.push_back({handle, random_transform(trial.random)});
            const std::span<const Movement> all = movements;
            for (std::size_t i = 0; i < slices; ++i) {
                const std::size_t from = all.size() * i / slices, to = all.size() * (i + 1) / slices;
                REQUIRE(move(trial.made.scene, all.subspan(from, to - from)).count == to - from);
            }
            refit(trial.made.scene);
            if (round % 8 == 7) repack(trial.made.scene);
        }
        return snapshot_of(trial.made.scene);
    };
    const std::vector<std::byte> whole = bytes_after(1);
    CHECK(bytes_after(2) == whole);
    CHECK(bytes_after(7) == whole);
}

TEST_CASE("scene: a snapshot of other meshes is refused") {
    MadeScene made(4, step_exponent, parts().meshes, parts().tiles);
    (void)*insert(made.scene, instance_at_place({}, 1));
    (void)*insert(made.scene, instance_at_place({}, 3));
    CHECK(open_moving_scene(made.bytes(), parts().meshes, parts().tiles));
    CHECK_FALSE(open_moving_scene(made.bytes(), parts().meshes));
    std::vector<Blob> others = parts().meshes;
    std::swap(others[0], others[1]);
    CHECK_FALSE(open_moving_scene(made.bytes(), others, parts().tiles));
    others[1] = parts().meshes[2];
    CHECK_FALSE(open_moving_scene(made.bytes(), others, parts().tiles));
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_scene_test
