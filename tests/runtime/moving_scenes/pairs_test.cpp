// Claims about pairs of instances whose boxes touch.
#include "support/testing.hpp"

#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/touching_pairs.hpp>

#include "made_block.hpp"
#include "made_scene.hpp"

namespace espalier::tests::pairs_test {
namespace {

using namespace espalier::detail;

std::vector<InstancePair> list_in_pages(SceneBlock& block, std::size_t size, const PairFilter& filter = {}) {
    return in_pages<InstancePair>(size, [&](std::span<InstancePair> page, InstancePair from) {
        return collect_touching_pairs(block, page, filter, from);
    });
}

TEST_CASE("scene: pairs of moving instances are sorted and those of the loop in pages of any size") {
    Random random(1);
    for (const std::uint32_t count : {0u, 1u, 2u, 50u, 300u}) {
        CAPTURE(count);
        MadeBlock made(count + 1);
        std::vector<std::uint32_t> live;
        // Some touch many: a giant, and points at one place.
        if (count > 2) live.push_back(made.insert({{-(1 << 24), 0, 0}, {1 << 24, 1 << 24, 1 << 24}}));
        for (std::uint32_t i = 2; i < count; ++i)
            live.push_back(made.insert(i % 4 == 0 ? StepsBox{{5, 5, 5}, {5, 5, 5}} : random_box(random, 1 << 22)));
        for (int i = 0; i < 10 && live.size() > 20; ++i) {
            made.remove(live.back());
            live.pop_back();
        }
        const std::vector<InstancePair> loop = loop_over_slots(made.block);
        CHECK((count < 50 || loop.size() > count / 2));
        for (const std::size_t size :
             {std::size_t{1}, std::size_t{7}, std::size_t{100}, loop.size(), std::size_t{100'000}}) {
            CAPTURE(size);
            if (size == 0 || (size == 1 && count > 50)) continue;
            CHECK(list_in_pages(made.block, size) == loop);
        }
    }
}

TEST_CASE("scene: a page of pairs without room is empty and leads to the first pair") {
    MadeBlock made(10);
    for (int i = 0; i < 3; ++i) made.insert({{10 * i, 0, 0}, {10 * i + 10, 10, 10}});
    const FilledPairs<InstancePair> page = collect_touching_pairs(made.block, {}, {}, {});
    CHECK(page.count == 0);
    CHECK(page.status == QueryStatus::output_full);
    CHECK(page.next == InstancePair{0, 1});
    CHECK(list_in_pages(made.block, 1).size() == 2);
}

TEST_CASE("scene: filters and masks and what moved select pairs of moving instances") {
    Random random(2);
    MadeBlock made(300);
    SceneBlock& block = made.block;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const std::uint32_t slot = made.insert(random_box(random, 1 << 19));
        block.masks[slot] = 1u << random.below(4) | 1u << random.below(4);
    }
    for (int round = 0; round < 20; ++round) {
        CAPTURE(round);
        ++block.head->step;
        for (std::uint32_t slot = 0; slot < 300; ++slot)
            if (random.below(10) < static_cast<std::uint32_t>(round) % 5) block.moved[slot] = block.head->step;
        if (round == 10) repack_boxes(block);
        const auto keep = [](InstanceId a, InstanceId b) { return (a.index + b.index) % 3 != 0; };
        const PairFilter filter = {round % 2 == 0, round % 3 == 0 ? FunctionRef<bool(InstanceId, InstanceId)>(keep)
                                                                  : FunctionRef<bool(InstanceId, InstanceId)>()};
        std::vector<InstancePair> expected;
        for (const InstancePair& pair : loop_over_slots(block)) {
            const bool moved = has_moved(block, pair.a) || has_moved(block, pair.b);
            if ((block.masks[pair.a] & block.masks[pair.b]) != 0 && (moved || !filter.only_moved) &&
                (!filter.keep || keep({pair.a}, {pair.b})))
                expected.push_back(pair);
        }
        CHECK((round % 5 == 0 || expected.size() > 20));
        CHECK(list_in_pages(block, 10'000, filter) == expected);
        CHECK(list_in_pages(block, 9, filter) == expected);
        CHECK(is_sound(block));
    }
}

TEST_CASE("scene: pairs that moved leave out free slots and what lies behind the slots in use") {
    Random random(3);
    MadeBlock made(100);
    SceneBlock& block = made.block;
    const BlockHead& head = *block.head;
    const StepsBox large = {{0, 0, 0}, {1 << 19, 1 << 19, 1 << 19}};
    for (int i = 0; i < 60; ++i) made.insert(i == 3 || i == 20 ? large : random_box(random, 1 << 19));
    block.head->step = 2;
    for (const std::uint32_t slot : {3u, 7u, 9u}) block.moved[slot] = head.step;
    made.remove(7);
    made.remove(9);
    // A copy of an instance that has not moved, as one that has.
    const std::uint32_t behind = head.slots_used;
    block.slots[behind] = block.slots[20];
    block.moved[behind] = head.step;
    const std::vector<InstancePair> loop = loop_over_slots(block);
    std::vector<InstancePair> moved;
    for (const InstancePair& pair : loop)
        if (pair.a == 3 || pair.b == 3) moved.push_back(pair);
    REQUIRE(moved.size() > 2);
    for (const std::size_t size : {std::size_t{1}, std::size_t{10'000}}) {
        CHECK(list_in_pages(block, size, {true, {}}) == moved);
        CHECK(list_in_pages(block, size) == loop);
    }
}

TEST_CASE("scene: a filter that contradicts itself gets a list that fits") {
    MadeBlock made(60);
    for (int i = 0; i < 60; ++i) made.insert({{i, 0, 0}, {i + 30, 9, 9}});
    std::uint64_t calls = 0;
    for (std::uint64_t kind = 2; kind < 6; ++kind)
        for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{40}, std::size_t{2'000}}) {
            std::vector<InstancePair> page(size + 100, InstancePair{7, 7});
            const auto keep = [&](InstanceId, InstanceId) { return ++calls / kind % 2 == 0; };
            const PairFilter filter = {false, keep};
            const auto found = collect_touching_pairs(made.block, std::span(page).first(size), filter, {});
            REQUIRE(found.count <= size);
            const std::span<const InstancePair> list = found.in(page);
            CHECK(std::is_sorted(list.begin(), list.end()));
            for (std::size_t i = size; i < page.size(); ++i) REQUIRE(page[i] == InstancePair{7, 7});
        }
}

TEST_CASE("scene: questions for pairs leave the bytes of a block as they are") {
    Random random(3);
    MadeBlock made(100);
    for (int i = 0; i < 100; ++i) made.insert(random_box(random, 1 << 20));
    const std::vector<std::byte> before(made.bytes(), made.bytes() + made.size());
    const auto is_same = [&] { return std::equal(before.begin(), before.end(), made.bytes()); };
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{30}, std::size_t{10'000}})
        for (const InstancePair from : {InstancePair{}, InstancePair{20, 3}}) {
            std::vector<InstancePair> page(size);
            const auto found = collect_touching_pairs(made.block, page, {}, from);
            CHECK((found.count != 0 || size == 0));
            CHECK(is_same());
        }
}

}  // namespace
}  // namespace espalier::tests::pairs_test
