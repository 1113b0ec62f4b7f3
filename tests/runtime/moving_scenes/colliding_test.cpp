// Claims about colliding pairs: those whose meshes overlap(), among moving instances and with a baked scene.
#include "support/testing.hpp"

#include "made_scene.hpp"

namespace espalier::tests::colliding_test {
namespace {

std::vector<Instance> some_instances(Random& random, std::size_t count, float place, std::uint32_t kinds) {
    std::vector<Instance> all(count);
    for (Instance& instance : all) {
        instance.transform.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f};
        instance.transform.translation = random.in_cube(place);
        instance.transform.scale = 0.5f + random.unit();
        instance.mesh = random.below(kinds);
        instance.mask = 1u << random.below(3) | 1u << random.below(3);
    }
    return all;
}

/// Meshes, a tile of them, and a baked scene with tiles.
struct World : SceneParts {
    explicit World(Random random)
        : SceneParts({make_torus(14, 8, 1.0, 0.3), make_icosphere(1, 0.8, {0.1f, 0.0f, 0.0f}), make_cube(-0.5f, 0.5f)},
                     {some_instances(random, 6, 3.0f, 3)}),
          baked(opened, some_instances(random, 60, 6.0f, 4), opened_tiles) {}
    OpenedScene baked;
};

const World& world() {
    static const World all(Random(1));
    return all;
}

/// A mesh at a place, or in a tile at a place.
struct Part {
    const Blob* mesh;
    Transform transform;
    const BakedScene* tile;  ///< null for a mesh
};
Part part_of(const Instance& instance) {
    const std::size_t meshes = world().meshes.size();
    if (instance.mesh < meshes) return {&world().meshes[instance.mesh], instance.transform, nullptr};
    return {nullptr, instance.transform, &world().tiles[instance.mesh - meshes]};
}
bool touches(const Blob& a, const Transform& at_a, const Blob& b, const Transform& at_b) {
    return overlaps(PlacedBlob(a, at_a), PlacedBlob(b, at_b), WorkLimit::unlimited()).yes();
}
/// Returns whether meshes of two parts touch: the loop over the instances of tiles, seen from their local spaces.
bool touches(const Part& a, const Part& b) {
    if (a.tile == nullptr && b.tile == nullptr) return touches(*a.mesh, a.transform, *b.mesh, b.transform);
    if (a.tile == nullptr) return touches(b, a);
    const Transform b_in_a = to_local(a.transform, b.transform);
    for (std::uint32_t i = 0; i < a.tile->instance_count(); ++i) {
        const Instance inner = *instance_at(*a.tile, InstanceId{i});
        const Blob mesh = *mesh_at(*a.tile, {i});
        if (b.tile == nullptr) {
            if (touches(*b.mesh, b_in_a, mesh, inner.transform)) return true;
        } else if (touches({nullptr, b_in_a, b.tile}, {&mesh, inner.transform, nullptr})) {
            return true;
        }
    }
    return false;
}

/// A moving scene of parts, and what a loop over all pairs finds in it.
struct Trial {
    MadeScene made;
    std::vector<Instance> instances;

    explicit Trial(std::uint64_t seed) : made(80, -14, world().meshes, world().tiles) {
        Random random(seed);
        instances = some_instances(random, 60, 5.0f, 4);
        for (const Instance& instance : instances) REQUIRE(insert(made.scene, instance));
        if (random.coin()) repack(made.scene);
    }
    [[nodiscard]] std::vector<InstancePair> loop(std::uint32_t moved_end, bool collide) const {
        std::vector<InstancePair> pairs;
        for (std::uint32_t a = 0; a < instances.size(); ++a)
            for (std::uint32_t b = a + 1; b < instances.size(); ++b) {
                if ((instances[a].mask & instances[b].mask) == 0 || a >= moved_end) continue;
                const Box box_a = *box_of(made.scene, *handle_of(made.scene, a));
                const Box box_b = *box_of(made.scene, *handle_of(made.scene, b));
                if (share_a_point(box_a, box_b) && (!collide || touches(part_of(instances[a]), part_of(instances[b]))))
                    pairs.push_back({a, b});
            }
        return pairs;
    }
    [[nodiscard]] std::vector<BakedPair> loop(const BakedScene& baked, bool collide) const {
        std::vector<BakedPair> pairs;
        for (std::uint32_t a = 0; a < instances.size(); ++a) {
            const Box box = *box_of(made.scene, *handle_of(made.scene, a));
            const auto each = [&](InstanceId id) {
                Part part = part_of(instances[a]);
                if (id.in_tile != no_instance.in_tile)
                    part.transform = to_local(instance_at(baked, InstanceId{id.index})->transform, part.transform);
                const Blob mesh = *mesh_at(baked, id);
                if (!collide || touches(part, {&mesh, instance_at(baked, id)->transform, nullptr}))
                    pairs.push_back({a, id});
            };
            REQUIRE(for_each_candidate(baked, box, each, instances[a].mask) == QueryStatus::ok);
        }
        return pairs;
    }
};

TEST_CASE("scene: colliding pairs of moving instances are those whose meshes overlap in pages of any size") {
    std::size_t found = 0;
    for (std::uint64_t seed = 0; seed < scaled(10); ++seed) {
        CAPTURE(seed);
        Trial trial(seed);
        MovingScene& scene = trial.made.scene;
        const std::vector<InstancePair> expected = trial.loop(60, true);
        found += expected.size();
        for (const std::size_t size : {std::size_t{3}, std::size_t{40}, std::size_t{2'000}}) {
            CAPTURE(size);
            CHECK(in_pages<InstancePair>(size, [&](std::span<InstancePair> page, InstancePair from) {
                      return collect_colliding_pairs(scene, page, WorkLimit::unlimited(), {}, from);
                  }) == expected);
        }
        CHECK(in_pages<InstancePair>(50, [&](std::span<InstancePair> page, InstancePair from) {
                  return collect_candidate_pairs(scene, page, {}, from);
              }) == trial.loop(60, false));
    }
    CHECK(found > scaled(10) * 20);
}

TEST_CASE("scene: pairs of a moving and a baked scene are those of the loop in pages of any size") {
    const BakedScene& baked = world().baked.scene;
    std::size_t found = 0, in_tiles = 0;
    for (std::uint64_t seed = 20; seed < 20 + scaled(5); ++seed) {
        CAPTURE(seed);
        const Trial trial(seed);
        const MovingScene& scene = trial.made.scene;
        const std::vector<BakedPair> candidates = trial.loop(baked, false), expected = trial.loop(baked, true);
        found += expected.size();
        for (const BakedPair& pair : expected) in_tiles += pair.baked.in_tile != no_instance.in_tile ? 1u : 0u;
        REQUIRE(candidates.size() > expected.size());
        for (const std::size_t size : {std::size_t{5}, std::size_t{10'000}}) {
            CAPTURE(size);
            CHECK(in_pages<BakedPair>(size, [&](std::span<BakedPair> page, BakedPair from) {
                      return collect_candidate_pairs(scene, baked, page, {}, from);
                  }) == candidates);
            CHECK(in_pages<BakedPair>(size, [&](std::span<BakedPair> page, BakedPair from) {
                      return collect_colliding_pairs(scene, baked, page, WorkLimit::unlimited(), {}, from);
                  }) == expected);
        }
    }
    CHECK(found > scaled(5) * 20);
    CHECK(in_tiles > scaled(5));
}

TEST_CASE("scene: a limit of work ends a page of colliding pairs and the next page goes on") {
    Trial trial(7);
    MovingScene& scene = trial.made.scene;
    const BakedScene& baked = world().baked.scene;
    std::vector<InstancePair> pairs(2'000);
    std::vector<BakedPair> baked_pairs(2'000);
    CHECK(collect_colliding_pairs(scene, pairs, WorkLimit(0)).status == QueryStatus::work_limit);
    CHECK(collect_colliding_pairs(scene, baked, baked_pairs, WorkLimit(0)).status == QueryStatus::work_limit);
    CHECK(in_pages<InstancePair>(100, [&](std::span<InstancePair> page, InstancePair from) {
              return collect_colliding_pairs(scene, page, WorkLimit(5'000), {}, from);
          }) == trial.loop(60, true));
    CHECK(in_pages<BakedPair>(100, [&](std::span<BakedPair> page, BakedPair from) {
              return collect_colliding_pairs(scene, baked, page, WorkLimit(5'000), {}, from);
          }) == trial.loop(baked, true));
}

TEST_CASE("scene: a pair is out of range where no floats hold the place of one in the tile of the other") {
    const std::vector<OpenedBlob> cubes = opened_blobs({make_cube(-0.5f, 0.5f)});
    std::vector<OpenedScene> tiles;
    tiles.emplace_back(cubes, std::vector<Instance>(1));
    std::vector<Instance> instances(1);
    instances[0].mesh = 1;
    instances[0].transform.scale = 0x1p60f;
    const OpenedScene baked(cubes, instances, tiles);
    REQUIRE(baked.scene);
    MadeScene made(4, -12, baked.meshes, baked.tiles);
    Instance small = {.transform = {{}, {}, 0x1p-100f}};
    REQUIRE(insert(made.scene, small));
    refit(made.scene);
    BakedPair pairs[4];
    REQUIRE(collect_candidate_pairs(made.scene, baked.scene, pairs).count == 1);
    const FilledPairs<BakedPair> filled =
        collect_colliding_pairs(made.scene, baked.scene, pairs, WorkLimit::unlimited());
    CHECK(filled.status == QueryStatus::out_of_range);
    CHECK(filled.count == 0);
    CHECK(filled.next == pairs[0]);
}

TEST_CASE("scene: what has moved and what a filter keeps select colliding pairs") {
    Trial trial(9);
    MovingScene& scene = trial.made.scene;
    const BakedScene& baked = world().baked.scene;
    end_step(scene);
    std::vector<InstancePair> pairs(2'000);
    std::vector<BakedPair> baked_pairs(5'000);
    const PairFilter moved = {true, {}};
    CHECK(collect_candidate_pairs(scene, pairs, moved).count == 0);
    CHECK(collect_candidate_pairs(scene, baked, baked_pairs, moved).count == 0);
    // The first of all pairs of slots below 5 is the one that moves.
    for (std::uint32_t slot = 0; slot < 5; ++slot)
        REQUIRE(move(scene, *handle_of(scene, slot), trial.instances[slot].transform) == QueryStatus::ok);
    const FilledPairs<InstancePair> found = collect_colliding_pairs(scene, pairs, WorkLimit::unlimited(), moved);
    const auto in_first = found.in(pairs);
    CHECK(std::vector<InstancePair>(in_first.begin(), in_first.end()) == trial.loop(5, true));
    const auto even = [](InstanceId a, InstanceId b) { return (a.index + b.index) % 2 == 0; };
    const PairFilter filter = {false, even};
    std::size_t kept = 0;
    for (const BakedPair& pair : trial.loop(baked, true)) kept += even({pair.moving}, pair.baked) ? 1u : 0u;
    CHECK(collect_colliding_pairs(scene, baked, baked_pairs, WorkLimit::unlimited(), filter).count == kept);
    CHECK(kept > 10);
    CHECK(collect_candidate_pairs(scene, BakedScene{}, baked_pairs).status == QueryStatus::not_open);
}

}  // namespace
}  // namespace espalier::tests::colliding_test
