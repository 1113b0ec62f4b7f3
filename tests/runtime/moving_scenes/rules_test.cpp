// Claims about the rules of a block: open_moving_scene() refuses one that breaks a single rule and keeps the others.
#include "support/testing.hpp"

#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "made_bytes.hpp"

namespace espalier::tests::moving_scenes_rules_test {
namespace {

using namespace espalier::detail;

/// Swaps the first child of a node of nodes with a place that has none.
void free_first_place(SceneBlock& block, std::uint32_t node) {
    BoxNode& all = block.node(node);
    const unsigned place = all.free_place();
    REQUIRE(place < BoxNode::most);
    all.set(place, all.box(0), all.child[0]);
    block.parent[all.child[0]] = 8 * node + place;
    all.drop(0);
}

TEST_CASE("scene: each rule of the head of a moving scene broken alone is refused") {
    REQUIRE(EditedBlock(large_scene()).head.levels == 3);
    REQUIRE(EditedBlock(large_scene()).head.free_nodes > 1);
    check_breaches(large_scene(),
                   {{"magic", [](EditedBlock& edited) { ++edited.head.magic; }},
                    {"capacity of nodes", [](EditedBlock& edited) { ++edited.head.node_capacity; }},
                    {"step exponent", [](EditedBlock& edited) { ++edited.head.step_exponent; }},
                    {"fewer levels", [](EditedBlock& edited) { --edited.head.levels; }},
                    {"more levels", [](EditedBlock& edited) { ++edited.head.levels; }},
                    {"whether a refit must follow", [](EditedBlock& edited) { edited.head.must_refit = 2; }},
                    {"too large a common region", [](EditedBlock& edited) { edited.head.common_region = 8; }},
                    {"fewer instances", [](EditedBlock& edited) { --edited.head.live; }},
                    {"more instances", [](EditedBlock& edited) { ++edited.head.live; }},
                    {"fewer slots", [](EditedBlock& edited) { --edited.head.slots_used; }},
                    {"more slots", [](EditedBlock& edited) { edited.head.slots_used = edited.head.slot_capacity + 1; }},
                    {"no free slot", [](EditedBlock& edited) { edited.head.free_slot = no_child; }},
                    {"a live slot as free", [](EditedBlock& edited) { edited.head.free_slot = 1; }},
                    {"fewer nodes", [](EditedBlock& edited) { --edited.head.nodes_used; }},
                    {"more nodes", [](EditedBlock& edited) { ++edited.head.nodes_used; }},
                    {"fewer free nodes", [](EditedBlock& edited) { --edited.head.free_nodes; }},
                    {"more free nodes", [](EditedBlock& edited) { ++edited.head.free_nodes; }},
                    {"no free node", [](EditedBlock& edited) { edited.head.free_node = no_child; }},
                    {"no root", [](EditedBlock& edited) { edited.head.root = no_child; }},
                    {"another root", [](EditedBlock& edited) { edited.head.root = leaf_of(edited.block); }},
                    {"no step", [](EditedBlock& edited) { edited.head.step = 0; }},
                    {"a finer lattice", [](EditedBlock& edited) { edited.head.coarseness.coarsest_step *= 0.75f; }},
                    {"a smaller scale", [](EditedBlock& edited) { edited.head.coarseness.largest_scale *= 0.75f; }},
                    {"a nearer origin", [](EditedBlock& edited) { edited.head.coarseness.farthest_origin *= 0.75f; }},
                    {"no lattice", [](EditedBlock& edited) { edited.head.coarseness.coarsest_step = not_a_number; }},
                    {"a quality of minus zero", [](EditedBlock& edited) { edited.head.packed_area = -0.0f; }},
                    {"a quality of a half", [](EditedBlock& edited) { edited.head.packed_area = 0.5f; }},
                    {"a quality without end", [](EditedBlock& edited) { edited.head.packed_area = infinity; }}});
}

TEST_CASE("scene: each rule of the head of an empty moving scene broken alone is refused") {
    MadeScene made(4, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    check_breaches(made.scene.bytes(),
                   {{"too coarse a step", [](EditedBlock& edited) { edited.head.step_exponent = 81; }},
                    {"too fine a step", [](EditedBlock& edited) { edited.head.step_exponent = -101; }},
                    {"a root", [](EditedBlock& edited) { edited.head.root = 0; }},
                    {"a level", [](EditedBlock& edited) { edited.head.levels = 1; }},
                    {"no step", [](EditedBlock& edited) { edited.head.step = 0; }},
                    {"a node", [](EditedBlock& edited) { edited.head.nodes_used = 1; }},
                    {"a negative scale", [](EditedBlock& edited) { edited.head.coarseness.largest_scale = -1; }},
                    {"no quality", [](EditedBlock& edited) { edited.head.packed_area = not_a_number; }},
                    {"a negative quality", [](EditedBlock& edited) { edited.head.packed_area = -1.0f; }}});
}

TEST_CASE("scene: each rule of the slots of a moving scene broken alone is refused") {
    const auto first_free = [](EditedBlock& edited) -> InstanceSlot& {
        return edited.block.slots[edited.head.free_slot];
    };
    check_breaches(
        large_scene(),
        {{"an invalid transform",
          [](EditedBlock& edited) { edited.block.slots[1].transform.translation.x = not_a_number; }},
         {"no scale", [](EditedBlock& edited) { edited.block.slots[1].transform.scale = 0.0f; }},
         {"another place", [](EditedBlock& edited) { edited.block.slots[1].transform.translation.x += 1.0f; }},
         {"an origin between two of the grid", [](EditedBlock& edited) { edited.block.slots[1].origin[1] = 64; }},
         {"an origin that moves the box", [](EditedBlock& edited) { edited.block.slots[1].origin[2] = 128; }},
         {"an origin beyond the world", [](EditedBlock& edited) { edited.block.slots[1].origin[0] = -(1 << 30); }},
         {"an origin of a free slot beyond the world",
          [&](EditedBlock& edited) { first_free(edited).origin[0] = 1 << 30; }},
         {"a movement in a later step", [](EditedBlock& edited) { edited.block.moved[1] = edited.head.step + 1; }},
         {"another box", [](EditedBlock& edited) { ++edited.block.slots[1].box.high[2]; }},
         {"no mesh", [](EditedBlock& edited) { edited.block.slots[1].mesh = 3; }},
         {"a number in the room for pairs", [](EditedBlock& edited) { edited.block.counts[0] = 1; }},
         {"a number at the end of the room for pairs",
          [](EditedBlock& edited) { edited.block.counts[edited.head.slot_capacity - 1] = 1; }},
         {"a free slot that is alive", [&](EditedBlock& edited) { ++first_free(edited).generation; }},
         {"a live slot that is free", [](EditedBlock& edited) { ++edited.block.slots[1].generation; }},
         {"a circle of free slots", [&](EditedBlock& edited) { first_free(edited).place = edited.head.free_slot; }},
         {"a worn slot among the free ones",
          [&](EditedBlock& edited) {
              // The list is as long as before: a free slot is no longer in it.
              first_free(edited).generation = 0;
              first_free(edited).place = edited.block.slots[first_free(edited).place].place;
          }},
         {"a worn slot in the tree",
          [&](EditedBlock& edited) {
              InstanceSlot& worn = first_free(edited);
              const std::uint32_t number = edited.head.free_slot, at = edited.block.slots[1].place;
              edited.head.free_slot = worn.place;
              worn = edited.block.slots[1];
              worn.generation = 0;
              edited.block.node(at / 8).child[at % 8] = number;
          }},
         {"a live slot that is not in the tree", [](EditedBlock& edited) {
              std::uint32_t slot = 1;
              const auto siblings = [&] { return edited.block.node(edited.block.slots[slot].place / 8).count(); };
              while (!is_live(edited.block.slots[slot]) || siblings() == BoxNode::least) ++slot;
              drop_slot(edited.block, slot);
          }}});
}

TEST_CASE("scene: each rule of the nodes of a moving scene broken alone is refused") {
    check_breaches(large_scene(),
                   {{"too few children",
                     [](EditedBlock& edited) {
                         // Instances of one leaf node end their lives one after the other.
                         const std::uint32_t leaf = leaf_of(edited.block);
                         while (edited.block.node(leaf).count() >= BoxNode::least) {
                             unsigned place = 0;
                             while (edited.block.node(leaf).child[place] == no_child) ++place;
                             const std::uint32_t slot = edited.block.node(leaf).child[place];
                             drop_slot(edited.block, slot);
                             give_back_slot(edited.block, slot);
                         }
                     }},
                    {"a child twice",
                     [](EditedBlock& edited) {
                         BoxNode& root = edited.block.node(edited.head.root);
                         root.set(root.free_place(), root.box(0), root.child[0]);
                     }},
                    {"a box in an empty place",
                     [](EditedBlock& edited) {
                         BoxNode& root = edited.block.node(edited.head.root);
                         root.high[0][root.free_place()] = 0;
                     }},
                    {"a larger box",
                     [](EditedBlock& edited) {
                         const std::uint32_t at = edited.block.parent[leaf_of(edited.block)];
                         ++edited.block.node(at / 8).high[1][at % 8];
                     }},
                    {"a mark without a refit that must follow",
                     [](EditedBlock& edited) { edited.block.dirty[leaf_of(edited.block)] = 1; }},
                    {"a root with a parent", [](EditedBlock& edited) { edited.block.parent[edited.head.root] = 0; }},
                    {"another parent", [](EditedBlock& edited) { ++edited.block.parent[leaf_of(edited.block)]; }},
                    {"a node that is in no list", [](EditedBlock& edited) {
                         edited.head.free_node = edited.block.node(edited.head.free_node).child[0];
                         --edited.head.free_nodes;
                     }}});
    check_breaches(large_scene(true),
                   {{"another mark", [](EditedBlock& edited) { edited.block.dirty[leaf_of(edited.block)] = 2; }},
                    {"an old box outside of the world",
                     [](EditedBlock& edited) {
                         const std::uint32_t leaf = leaf_of(edited.block);
                         REQUIRE(edited.block.dirty[leaf] == 1);
                         const std::uint32_t at = edited.block.parent[leaf];
                         edited.block.node(at / 8).high[0][at % 8] = most_world_steps + 1;
                     }},
                    {"an old box of a node without a mark, above one with a mark", [](EditedBlock& edited) {
                         const std::uint32_t leaf = leaf_of(edited.block);
                         REQUIRE(edited.block.dirty[leaf] == 1);
                         const std::uint32_t at = edited.block.parent[edited.block.parent[leaf] / 8];
                         ++edited.block.node(at / 8).high[0][at % 8];
                     }}});
}

TEST_CASE("scene: a chain of more nodes than a tree may have levels is refused") {
    // Every node has one that is sound, and is left for it before the others are looked at.
    EditedBlock edited(make_bytes(1'000, 10, false));
    const std::uint32_t length = 256;
    REQUIRE(length < edited.head.node_capacity);
    for (std::uint32_t node = 0; node < length; ++node) {
        edited.block.node(node).clear();
        for (unsigned place = 0; place < BoxNode::least; ++place)
            edited.block.node(node).set(place, {{0, 0, 0}, {0, 0, 0}}, node + 1);
        edited.block.parent[node] = node == 0 ? no_child : 8 * (node - 1);
    }
    edited.head.root = 0;
    edited.head.free_node = no_child;
    edited.head.free_nodes = 0;
    edited.head.nodes_used = length + 1;
    for (const std::uint32_t levels : {13u, 100u, 255u}) {
        edited.head.levels = static_cast<std::uint8_t>(levels);
        CHECK_FALSE(edited.opens());
    }
}

TEST_CASE("scene: live slots without a tree are refused") {
    EditedBlock edited(large_scene());
    const std::uint32_t nodes = edited.head.nodes_used;
    for (std::uint32_t node = 0; node < nodes; ++node) {
        edited.block.node(node).clear();
        edited.block.node(node).child[0] = node + 1 < nodes ? node + 1 : no_child;
        edited.block.parent[node] = no_child;
    }
    edited.head.free_node = 0;
    edited.head.free_nodes = nodes;
    edited.head.levels = 0;
    edited.head.root = no_child;
    CHECK_FALSE(edited.opens());
}

TEST_CASE("scene: a free node that is in the tree or has a parent or a mark is refused") {
    const std::vector<std::byte> bytes = large_scene();
    std::size_t tried = 0;
    const std::uint32_t nodes = EditedBlock(bytes).head.nodes_used;
    for (std::uint32_t node = 0; node < nodes; ++node) {
        CAPTURE(node);
        EditedBlock edited(bytes);
        const SceneBlock& block = edited.block;
        const std::uint32_t last = last_free_node(block);
        if (node == edited.head.root) free_first_place(edited.block, node);
        if (node == last || block.node(node).child[0] != no_child) continue;
        REQUIRE(edited.opens());
        std::uint32_t before = edited.head.free_node;
        while (block.node(before).child[0] != last) before = block.node(before).child[0];
        block.node(before).child[0] = node;  // the list is as long as before
        CHECK_FALSE(edited.opens());
        ++tried;
    }
    CHECK(tried > 1);
    EditedBlock edited(bytes);
    edited.block.parent[edited.head.free_node] = 8 * edited.head.root;
    CHECK_FALSE(edited.opens());
    for (const bool must_refit : {false, true}) {
        EditedBlock marked(large_scene(must_refit));
        marked.block.dirty[marked.head.free_node] = 1;
        CHECK_FALSE(marked.opens());
    }
}

TEST_CASE("scene: the quality of large instances under small boxes of before is a large number") {
    MadeScene made(64, -12, cubes_and_tile().meshes);
    MovingScene& scene = made.scene;
    std::vector<Movement> movements;
    for (int i = 0; i < 64; ++i) movements.push_back({*insert(scene, {}), {{}, {}, 0x1.8p17f}});
    repack(scene);
    REQUIRE(move(scene, movements).count == 64);
    CHECK(quality(scene) > 0x1p34f);
    CHECK(quality(scene) < 0x1p36f);
}

}  // namespace
}  // namespace espalier::tests::moving_scenes_rules_test
