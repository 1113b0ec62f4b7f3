// Claims about the tree over moving instances: it stays sound whatever is done to it, and misses no pair;
// and about the curve that a repack follows.
#include "support/testing.hpp"

#include <cstdlib>

#include <runtime/moving_scenes/box_tree/hilbert.hpp>
#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

#include "made_block.hpp"

namespace espalier::tests::moving_scenes_tree_test {
namespace {

using namespace espalier::detail;

constexpr std::int32_t region = 1 << 25;

using Pairs = std::vector<InstancePair>;

/// Returns the pairs that walks from each slot find, and on machines that are not small also the walk of all together.
Pairs pairs_of_tree(const SceneBlock& block) {
    Pairs all, of_slots;
    join_by_best_set(block, JoinedSlots::all, 0, [&](std::span<const InstancePair> touching) {
        for (const auto [a, b] : touching) all.push_back({std::min(a, b), std::max(a, b)});
    });
    for (std::uint32_t slot = 0; slot < block.head->slots_used; ++slot)
        if (is_live(block.slots[slot]))
            join_by_best_set(block, JoinedSlots::one, slot, [&](std::span<const InstancePair> touching) {
                for (const auto [a, b] : touching) {
                    REQUIRE(a == slot);
                    if (a < b) of_slots.push_back({a, b});
                }
            });
    std::sort(all.begin(), all.end());
    std::sort(of_slots.begin(), of_slots.end());
    if (!small_code) REQUIRE(all == of_slots);
    return of_slots;
}
/// Returns the most levels that so many instances may take: each node but the root has four children or more.
std::uint32_t most_levels(std::uint32_t live) {
    std::uint32_t levels = live == 0 ? 0 : 1;
    for (std::uint64_t least = 8; least <= live; least *= BoxNode::least) ++levels;
    return levels;
}

/// Checks what holds after each operation.
void check_block(const SceneBlock& block) {
    REQUIRE(is_sound(block));
    REQUIRE(block.head->levels <= most_levels(block.head->live));
}

/// A block, and the slots that are alive in it.
struct Model {
    MadeBlock made;
    std::vector<std::uint32_t> live;

    void insert(const StepsBox& box) { live.push_back(made.insert(box)); }
    void remove(std::size_t number) {
        made.remove(live[number]);
        live[number] = live.back();
        live.pop_back();
    }
    void operate(Random& random) {
        SceneBlock& block = made.block;
        const std::uint32_t what = random.below(40);
        const bool is_full = live.size() == block.head->slot_capacity;
        if (what < 18 && !is_full) return insert(random_box(random, region));
        if (live.empty()) return;
        const std::size_t number = random.below(static_cast<std::uint32_t>(live.size()));
        if (what < 30) return remove(number);
        if (what == 39) {
            block.head->must_refit = 0;
            return repack_boxes(block);
        }
        block.slots[live[number]].box = random_box(random, region);
        if (what < 35) return update_box(block, live[number]);
        set_box(block, live[number]);
        block.head->must_refit = 1;
        REQUIRE(is_sound(block));
        // Other changes may come before the refit.
        if (random.below(4) != 0) refit();
    }
    void refit() {
        refit_boxes(made.block);
        made.block.head->must_refit = 0;
    }
};

TEST_CASE("scene: a tree of moving instances stays sound through random insertions moves and removals") {
    Random random(1);
    for (const std::uint32_t capacity : {1u, 2u, 7u, 8u, 9u, 30u, 100u, 500u}) {
        CAPTURE(capacity);
        Model model{MadeBlock(capacity), {}};
        for (std::uint64_t i = 0; i < scaled(1'500); ++i) {
            CAPTURE(i);
            model.operate(random);
            check_block(model.made.block);
            if (i % 50 != 0) continue;
            model.refit();
            REQUIRE(is_sound(model.made.block));
            REQUIRE(pairs_of_tree(model.made.block) == loop_over_slots(model.made.block));
        }
        while (!model.live.empty()) model.remove(0);
        check_block(model.made.block);
        CHECK(model.made.block.head->levels == 0);
    }
}

TEST_CASE("scene: a tree of moving instances keeps its depth for insertions in any order") {
    constexpr std::uint32_t count = 3'000;
    const auto cube = [](std::int32_t x, std::int32_t y, std::int32_t z) {
        return StepsBox{{x, y, z}, {x + 100, y + 100, z + 100}};
    };
    const auto depth_of = [&](auto box_of) {
        MadeBlock made(count);
        for (std::uint32_t i = 0; i < count; ++i) made.insert(box_of(static_cast<std::int32_t>(i)));
        check_block(made.block);
        return made.block.head->levels;
    };
    CHECK(depth_of([&](std::int32_t i) { return cube(50 * i, 0, 0); }) <= most_levels(count));
    CHECK(depth_of([&](std::int32_t i) { return cube(i, i, i); }) <= most_levels(count));
    CHECK(depth_of([&](std::int32_t) { return cube(0, 0, 0); }) <= most_levels(count));
    CHECK(depth_of([&](std::int32_t i) { return cube(i % 55 * 200, i / 55 * 200, 0); }) <= most_levels(count));
    CHECK(depth_of([&](std::int32_t i) { return cube(i % 2 == 0 ? -i : i, 1 << 29, -(1 << 29)); }) <=
          most_levels(count));
}

TEST_CASE("scene: a block with nodes for any order of insertions repacks none") {
    for (const std::uint32_t capacity : {1u, 4u, 5u, 7u, 10u, 41u, 79u, 159u}) {
        CAPTURE(capacity);
        Model model{MadeBlock(capacity), {}};
        Random random(capacity);
        for (std::uint64_t i = 0; i < scaled(20'000); ++i) {
            const auto count = static_cast<std::uint32_t>(model.live.size());
            if (count == capacity || (count != 0 && random.below(2) == 0)) model.remove(random.below(count));
            else model.insert(random_box(random, 1 << 22));
        }
        CHECK(model.made.block.head->packed_area == 0.0f);
    }
}

TEST_CASE("scene: a tree is the same after a repack whatever came before it") {
    Random random(2);
    Model one{MadeBlock(300), {}};
    for (std::uint64_t i = 0; i < 2'000; ++i) one.operate(random);
    // The same slots and boxes in a block without a history.
    MadeBlock fresh(300);
    SceneBlock &a = one.made.block, &b = fresh.block;
    *b.head = *a.head;
    std::memcpy(b.slots, a.slots, sizeof(InstanceSlot) * a.head->slots_used);
    repack_boxes(a);
    repack_boxes(b);
    check_block(a);
    REQUIRE(a.head->nodes_used == b.head->nodes_used);
    REQUIRE(a.head->nodes_used <= a.head->live / 8 + a.head->live / 64 + 4);
    CHECK(std::memcmp(a.nodes, b.nodes, sizeof(BoxNode) * a.head->nodes_used) == 0);
    CHECK(std::memcmp(a.slots, b.slots, sizeof(InstanceSlot) * a.head->slots_used) == 0);
}

TEST_CASE("scene: a damaged block of moving instances is refused or every operation on it is safe") {
    Random random(5);
    Model model{MadeBlock(40), {}};
    for (std::uint64_t i = 0; i < 400; ++i) model.operate(random);
    REQUIRE(is_sound(model.made.block));
    std::size_t refused = 0, sound = 0;
    const std::uint64_t tries = scaled(20'000);
    for (std::uint64_t i = 0; i < tries; ++i) {
        MadeBlock damaged = model.made;
        for (std::uint32_t n = 1 + random.below(2); n > 0; --n) {
            const auto at = random.below(static_cast<std::uint32_t>(damaged.size()));
            damaged.bytes()[at] ^= static_cast<std::byte>(1u << random.below(8));
        }
        const BlockHead &own = *damaged.block.head, &first = *model.made.block.head;
        const bool has_capacity = own.slot_capacity == first.slot_capacity && own.node_capacity == first.node_capacity;
        if (!has_capacity || !is_sound(damaged.block)) {
            ++refused;
            continue;
        }
        ++sound;
        Model used{damaged, {}};
        SceneBlock& block = used.made.block;
        for (std::uint32_t slot = 0; slot < block.head->slots_used; ++slot)
            if (is_live(block.slots[slot])) used.live.push_back(slot);
        (void)pairs_of_tree(block);
        refit_boxes(block);
        block.head->must_refit = 0;
        for (int n = 0; n < 20 && !used.live.empty(); ++n) used.remove(0);
        while (used.live.size() < 40) used.insert(random_box(random, region));
        repack_boxes(block);
        check_block(block);
    }
    CHECK(refused > tries / 10);
    CHECK(sound > tries / 10);
}

TEST_CASE("scene: the curve through a cube passes each point once and steps to a neighbour") {
    constexpr unsigned bits = 4, side = 1u << bits;
    struct Point {
        int x = -1, y = 0, z = 0;
    };
    std::vector<Point> along(side * side * side);
    for (unsigned x = 0; x < side; ++x)
        for (unsigned y = 0; y < side; ++y)
            for (unsigned z = 0; z < side; ++z) {
                const std::uint32_t key = hilbert_key(x, y, z, bits);
                REQUIRE(key < along.size());
                REQUIRE(along[key].x == -1);
                along[key] = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(z)};
            }
    for (std::size_t i = 1; i < along.size(); ++i) {
        const Point &a = along[i - 1], &b = along[i];
        REQUIRE(std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z) == 1);
    }
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_tree_test
