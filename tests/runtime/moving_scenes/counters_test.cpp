// Claims about the counters of pairs of moving instances.
#include "support/testing.hpp"

#include <tuple>

#include <espalier/scenes/statistics.hpp>
#include <runtime/moving_scenes/access.hpp>

#include "made_block.hpp"
#include "made_scene.hpp"
#include "support/machine/chosen_instruction_set.hpp"

namespace espalier::tests::moving_scenes_counters_test {
namespace {

using namespace espalier::detail;

using Counts = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>;

Counts counts_of(const SceneCounters& counters) { return {counters.box_tests, counters.pairs, 0}; }
Counts counts_of(const PairCounters& counters) {
    return {counters.box_pairs, counters.leaf_pairs, counters.triangle_pairs};
}
/// The walks for pairs, by recursion.
class PlainWalk {
public:
    PlainWalk(const MovingScene& scene, bool only_moved) : block_(block_of(scene)) {
        if (block_.head->levels == 0) return;
        std::uint32_t moved = 0;
        for (std::uint32_t slot = 0; slot < block_.head->slots_used; ++slot) moved += has_moved(slot) ? 1u : 0u;
        const unsigned top = block_.head->levels - 1u;
        const auto root = block_.head->root;
        if (!only_moved || moved >= block_.head->live / 4) {
            for (unsigned i = 0; i < BoxNode::most; ++i) compare_nodes(root, i, root, top);
            return;
        }
        for (std::uint32_t slot = 0; slot < block_.head->slots_used; ++slot)
            if (has_moved(slot)) compare_slot(slot, root, top);
    }
    SceneCounters counters;

private:
    [[nodiscard]] bool has_moved(std::uint32_t slot) const {
        return block_.slots[slot].generation % 2 == 1 && block_.moved[slot] == block_.head->step;
    }
    /// A child of one node against another node of its level.
    void compare_nodes(std::uint32_t a, unsigned i, std::uint32_t b, unsigned level) {
        ++counters.box_tests;
        for (unsigned j = 0; j < BoxNode::most; ++j) {
            const StepsBox box = block_.node(b).box(j);
            if (!touch(block_.node(a).box(i), box)) continue;
            if (a == b && (level == 0 ? j <= i : j < i)) continue;
            if (level == 0) {
                ++counters.pairs;
                continue;
            }
            ++counters.box_tests;
            const std::uint32_t first = block_.node(a).child[i];
            for (unsigned k = 0; k < BoxNode::most; ++k)
                if (touch(block_.node(first).box(k), box)) compare_nodes(first, k, block_.node(b).child[j], level - 1);
        }
    }
    /// An instance against a node and what is below it.
    void compare_slot(std::uint32_t slot, std::uint32_t node, unsigned level) {
        ++counters.box_tests;
        for (unsigned i = 0; i < BoxNode::most; ++i) {
            const std::uint32_t child = block_.node(node).child[i];
            if (!touch(block_.slots[slot].box, block_.node(node).box(i))) continue;
            if (level != 0) compare_slot(slot, child, level - 1);
            else counters.pairs += child != slot ? 1u : 0u;
        }
    }

    SceneBlock block_;
};

/// Cubes and spheres anywhere in a region, of which some have moved since the step before.
struct Crowd {
    OpenedBlob cube = OpenedBlob(make_cube(-0.5f, 0.5f));
    OpenedBlob sphere = OpenedBlob(make_icosphere(2, 0.6, {}));
    std::vector<Blob> meshes = {cube.blob, sphere.blob};
    MadeScene made;

    Crowd(std::uint32_t count, std::uint64_t seed) : made(count + 1, -10, meshes) {
        Random random(seed);
        std::vector<InstanceHandle> handles;
        for (std::uint32_t i = 0; i < count; ++i) {
            Instance instance = {.transform = some_place(random, count),
                                 .mesh = i % 2,
                                 .mask = 1u << random.below(2) | 1u << random.below(2)};
            handles.push_back(*insert(made.scene, instance));
        }
        if (random.coin()) repack(made.scene);
        end_step(made.scene);
        for (std::uint32_t i = 0; i < count; i += 1 + random.below(20))
            REQUIRE(move(made.scene, handles[i], some_place(random, count)) == QueryStatus::ok);
    }
    static Transform some_place(Random& random, std::uint32_t count) {
        const float half_side = count < 100 ? 2.5f : 6.0f;
        const Quaternion rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), 1.0f};
        return {rotation, random.in_cube(half_side), 0.5f + random.unit()};
    }
};

constexpr std::uint32_t sizes[] = {0, 1, 2, 9, 60, 600};

TEST_CASE("work: the walk for pairs of moving instances counts what a recursion counts on every instruction set") {
    for (const std::uint32_t size : sizes)
        for (std::uint64_t seed = 0; seed < 1 + scaled(4); ++seed) {
            CAPTURE(size);
            CAPTURE(seed);
            Crowd crowd(size, seed);
            MovingScene& scene = crowd.made.scene;
            for (const bool only_moved : {false, true}) {
                CAPTURE(only_moved);
                const PairFilter filter = {only_moved, {}};
                const SceneCounters expected = PlainWalk(scene, only_moved).counters;
                CHECK((size < 60 || expected.pairs > size / 10));
                std::vector<InstancePair> plain(20 * size + 1), counted(20 * size + 1);
                on_each_instruction_set([&] {
                    SceneCounters counters;
                    const auto pairs = collect_candidate_pairs(scene, plain, filter);
                    const auto same = collect_candidate_pairs(scene, counted, counters, filter);
                    REQUIRE(pairs.status == QueryStatus::ok);
                    CHECK(same.status == pairs.status);
                    CHECK(same.next == pairs.next);
                    CHECK(same.count == pairs.count);
                    CHECK(counted == plain);
                    CHECK(counts_of(counters) == counts_of(expected));
                    // Masks select some of the pairs that are counted.
                    CHECK(same.count <= counters.pairs);
                    CHECK((size < 600 || same.count < counters.pairs));
                });
            }
        }
}

TEST_CASE("work: a page that is too small for the pairs of moving instances counts a walk for each slot at most") {
    Crowd crowd(300, 1);
    MovingScene& scene = crowd.made.scene;
    SceneCounters once, of_slots;
    std::vector<InstancePair> all(6'000);
    const auto whole = collect_candidate_pairs(scene, all, once);
    REQUIRE(whole.status == QueryStatus::ok);
    REQUIRE(whole.count > 200);
    REQUIRE(collect_candidate_pairs(scene, all, of_slots, {}, {0, 1}).count == whole.count);
    CHECK(of_slots.box_tests > once.box_tests);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100}, whole.count - 1}) {
        const std::span page = std::span(all).first(size);
        SceneCounters counters;
        CHECK(collect_candidate_pairs(scene, page, counters).status == QueryStatus::output_full);
        CHECK(counters.box_tests <= once.box_tests + of_slots.box_tests);
        PairCounters triangles;
        counters = {};
        CHECK(collect_colliding_pairs(scene, page, WorkLimit::unlimited(), counters, triangles).count <= size);
        CHECK(counters.box_tests <= once.box_tests + of_slots.box_tests);
    }
    SceneCounters of_pages;
    InstancePair from;
    while (from.a < 300) from = collect_candidate_pairs(scene, std::span(all).first(100), of_pages, {}, from).next;
    CHECK(of_pages.box_tests <= once.box_tests + 2 * of_slots.box_tests);
}

TEST_CASE("work: colliding pairs in a page without room take a walk for each slot however many there are") {
    OpenedBlob cube(make_cube(-0.5f, 0.5f));
    const std::vector<Blob> meshes = {cube.blob};
    constexpr std::uint32_t count = 100;
    MadeScene made(count, -12, meshes);
    Instance shell;  // each within the next: all boxes touch, and no triangles
    for (std::uint32_t i = 0; i < count; ++i) {
        shell.transform.scale = 1.0f + static_cast<float>(i);
        REQUIRE(insert(made.scene, shell));
    }
    InstancePair one;
    SceneCounters counters;
    PairCounters triangles;
    const auto none =
        collect_colliding_pairs(made.scene, std::span(&one, 1), WorkLimit::unlimited(), counters, triangles);
    CHECK(none.status == QueryStatus::ok);
    CHECK(none.count == 0);
    CHECK(counters.pairs <= count * (count + 1) * 2);
}

TEST_CASE("work: colliding pairs of moving instances count one walk and the work of all their candidates") {
    for (const std::uint32_t size : sizes) {
        CAPTURE(size);
        Crowd crowd(size, 7);
        MovingScene& scene = crowd.made.scene;
        std::vector<InstancePair> candidates(20 * size + 1), plain(20 * size + 1), counted(20 * size + 1);
        SceneCounters of_candidates;
        const auto found = collect_candidate_pairs(scene, candidates, of_candidates);
        REQUIRE(found.status == QueryStatus::ok);
        PairCounters expected;
        std::size_t colliding = 0;
        const auto placed = [&](std::uint32_t slot) {
            const Instance instance = *instance_at(scene, *handle_of(scene, slot));
            return PlacedBlob(crowd.meshes[instance.mesh], instance.transform);
        };
        for (const InstancePair& pair : found.in(candidates))
            if (first_contact(placed(pair.a), placed(pair.b), WorkLimit::unlimited(), expected)) ++colliding;
        on_each_instruction_set([&] {
            SceneCounters walk;
            PairCounters triangles;
            const WorkLimit limit(expected.box_pairs);
            const auto pairs = collect_colliding_pairs(scene, plain, limit);
            const auto same = collect_colliding_pairs(scene, counted, limit, walk, triangles);
            CHECK(same.status == QueryStatus::ok);
            CHECK(pairs.status == QueryStatus::ok);
            CHECK(same.count == colliding);
            CHECK(counted == plain);
            CHECK(counts_of(walk) == counts_of(of_candidates));
            CHECK(counts_of(triangles) == counts_of(expected));
        });
        if (expected.box_pairs == 0) continue;
        SceneCounters walk;
        PairCounters triangles;
        const WorkLimit less(expected.box_pairs - 1);
        const auto cut_short = collect_colliding_pairs(scene, counted, less, walk, triangles);
        CHECK(cut_short.status == QueryStatus::work_limit);
        CHECK(triangles.box_pairs == less.visits());
        CHECK(counts_of(walk) == counts_of(of_candidates));
    }
}

TEST_CASE("work: refused searches for pairs of moving instances count nothing") {
    Crowd crowd(60, 3);
    MovingScene nothing;
    std::vector<InstancePair> pairs(1'000);
    SceneCounters walk;
    PairCounters triangles;
    const auto check = [&](MovingScene& scene, QueryStatus status) {
        CHECK(collect_candidate_pairs(scene, pairs, walk).status == status);
        CHECK(collect_colliding_pairs(scene, pairs, WorkLimit(9), walk, triangles).status == status);
        CHECK(counts_of(walk) == Counts{});
        CHECK(counts_of(triangles) == Counts{});
    };
    check(nothing, QueryStatus::not_open);
    const std::vector<Movement> movements = {{*handle_of(crowd.made.scene, 5), {}}};
    REQUIRE(move(crowd.made.scene, movements).status == QueryStatus::ok);
    check(crowd.made.scene, QueryStatus::not_refitted);
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_counters_test
