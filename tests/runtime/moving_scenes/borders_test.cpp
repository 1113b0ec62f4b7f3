// Claims about the borders of a block's rules: open_moving_scene() keeps what is just within, and refuses what is just
// beyond, also where the rest of the block fits to it.
#include "support/testing.hpp"

#include <runtime/moving_scenes/access.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>
#include <runtime/moving_scenes/box_tree/tree.hpp>

#include "made_bytes.hpp"

namespace espalier::tests::borders_test {
namespace {

using namespace espalier::detail;

/// Moves a node of the tree into another node, with all numbers that lead to it.
void move_node(EditedBlock& edited, std::uint32_t from, std::uint32_t to) {
    SceneBlock& block = edited.block;
    const bool is_leaf = from == leaf_of(block);
    block.node(to) = block.node(from);
    block.dirty[to] = block.dirty[from];
    const std::uint32_t above = block.parent[to] = block.parent[from];
    if (above == no_child) edited.head.root = to;
    else block.node(above / 8).child[above % 8] = to;
    for (unsigned i = 0; i < BoxNode::most; ++i) {
        const std::uint32_t child = block.node(to).child[i];
        if (child == no_child) continue;
        (is_leaf ? block.slots[child].place : block.parent[child]) = 8 * to + i;
    }
}

/// Puts another slot into the list of free ones, in the place of the last.
void replace_last_free_slot(SceneBlock& block, std::uint32_t slot) {
    std::uint32_t* last = &block.head->free_slot;
    while (block.slots[*last].place != no_child) last = &block.slots[*last].place;
    *last = slot;
    block.slots[slot].place = no_child;
}

/// Puts another node into the list of free ones, in the place of the last.
void replace_last_free_node(SceneBlock& block, std::uint32_t node) {
    std::uint32_t* last = &block.head->free_node;
    while (block.node(*last).child[0] != no_child) last = &block.node(*last).child[0];
    *last = node;
    block.node(node).clear();
    block.parent[node] = no_child;
    block.dirty[node] = 0;
}

/// Sets the box that its parent has of the marked leaf node.
void set_old_box(EditedBlock& edited, const StepsBox& box) {
    const std::uint32_t leaf = leaf_of(edited.block);
    REQUIRE(edited.block.dirty[leaf] == 1);
    const std::uint32_t at = edited.block.parent[leaf];
    edited.block.node(at / 8).set_box(at % 8, box);
}

/// Gives an instance another scale, and its box to all that have it.
void set_scale(EditedBlock& edited, std::uint32_t number, float scale) {
    InstanceSlot& slot = edited.block.slots[number];
    slot.transform.scale = scale;
    const PartBounds bounds = bounds_of(data_of(cubes_and_tile().meshes[0]));
    REQUIRE(slot.mesh == 0);
    REQUIRE(find_steps_box(bounds, slot.transform, edited.head.step_exponent, slot.box));
    update_box(edited.block, number);
}

TEST_CASE("scene: a slot or node just behind those of a moving scene in use is refused") {
    const EditedBlock whole(large_scene());
    REQUIRE(whole.head.slots_used < whole.head.slot_capacity);
    REQUIRE(whole.head.nodes_used < whole.head.node_capacity);
    check_breaches(
        large_scene(),
        {{"a slot in the tree",
          [](EditedBlock& edited) {
              const std::uint32_t behind = edited.head.slots_used, place = edited.block.slots[1].place;
              edited.block.slots[behind] = edited.block.slots[1];
              edited.block.node(place / 8).child[place % 8] = behind;
          }},
         {"a free slot",
          [](EditedBlock& edited) {
              edited.block.slots[edited.head.slots_used].generation = 2;
              replace_last_free_slot(edited.block, edited.head.slots_used);
          }},
         {"a leaf node", [](EditedBlock& edited) { move_node(edited, leaf_of(edited.block), edited.head.nodes_used); }},
         {"a root", [](EditedBlock& edited) { move_node(edited, edited.head.root, edited.head.nodes_used); }},
         {"a free node", [](EditedBlock& edited) { replace_last_free_node(edited.block, edited.head.nodes_used); }}});
    // A node that is in use and free is kept.
    EditedBlock edited(large_scene());
    const std::uint32_t free = take_node(edited.block), leaf = leaf_of(edited.block);
    move_node(edited, leaf, free);
    give_back_node(edited.block, leaf);
    CHECK(edited.opens());
}

TEST_CASE("scene: a moving scene may have used all of its slots and nodes") {
    MadeScene made(4, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    for (int i = 0; i < 4; ++i) REQUIRE(insert(made.scene, {}));
    EditedBlock edited(made.scene.bytes());
    while (edited.head.nodes_used < edited.head.node_capacity) {
        give_back_node(edited.block, edited.head.nodes_used);
        ++edited.head.nodes_used;
    }
    CHECK(edited.head.free_nodes > 0);
    CHECK(edited.opens());
}

TEST_CASE("scene: a node that lies in the slots of a moving scene is refused") {
    // Boxes with ends at 0: where a node has them, its slots have the generation 0 of worn ones.
    MadeScene made(11, 0, cubes_and_tile().meshes, cubes_and_tile().tiles);
    for (int i = 0; i < 11; ++i) REQUIRE(insert(made.scene, {{{}, {-0.75f, 0.75f, 0.0f}, 1.0f}}));
    std::vector<std::byte> bytes(made.scene.bytes().begin(), made.scene.bytes().end());
    bytes.resize(bytes.size() + 32);
    EditedBlock edited(bytes);
    SceneBlock& block = edited.block;
    const StepsBox box = block.slots[10].box;
    REQUIRE(box.low[1] == 0);
    REQUIRE(box.high[0] == 0);
    const std::uint32_t behind = edited.head.node_capacity;
    edited.head.nodes_used = 0;
    edited.head.free_node = no_child;
    const std::uint32_t root = take_node(block), leaf = take_node(block);
    for (std::uint32_t slot = 3; slot < 7; ++slot) put_child(block, 0, leaf, slot - 3, box, slot);
    const auto put_leaf_nodes = [&](std::uint32_t first, std::uint32_t second) {
        put_child(block, 1, root, 0, box, first);
        put_child(block, 1, root, 1, box, second);
    };
    edited.head.root = root;
    edited.head.levels = 2;
    edited.head.live = 8;
    edited.head.free_slot = 2;
    edited.head.free_nodes = 0;
    // The other leaf node, first where it belongs.
    for (const std::uint32_t other : {take_node(block), behind}) {
        CAPTURE(other);
        block.node(other).clear();
        put_child(block, 0, other, 0, box, 7);
        put_child(block, 0, other, 1, box, 8);
        put_child(block, 0, other, 3, box, 9);
        put_child(block, 0, other, 6, box, 10);
        if (other != behind) {
            for (std::uint32_t slot = 0; slot < 3; ++slot) block.slots[slot].generation = slot & 2u;
        } else {
            give_back_node(block, 2);
            for (; edited.head.nodes_used < behind; ++edited.head.nodes_used)
                give_back_node(block, edited.head.nodes_used);
            ++edited.head.nodes_used;
        }
        block.slots[2].place = no_child;
        put_leaf_nodes(other, leaf);
        CHECK(edited.opens() == (other != behind));
    }
}

TEST_CASE("scene: a list of free slots or nodes that does not end is refused") {
    check_breaches(large_scene(),
                   {{"a circle of nodes",
                     [](EditedBlock& edited) {
                         edited.block.node(last_free_node(edited.block)).child[0] = edited.head.free_node;
                     }},
                    {"a circle of more nodes than there are",
                     [](EditedBlock& edited) {
                         edited.block.node(last_free_node(edited.block)).child[0] = edited.head.free_node;
                         edited.head.free_nodes = 0xFFFFFFFF;
                     }},
                    {"a node of the tree behind the last one", [](EditedBlock& edited) {
                         edited.block.node(last_free_node(edited.block)).child[0] = leaf_of(edited.block);
                     }}});
}

TEST_CASE("scene: a live slot of a moving scene that is neither counted nor in the tree is refused") {
    EditedBlock edited(large_scene());
    std::uint32_t slot = 1;
    const auto siblings = [&] { return edited.block.node(edited.block.slots[slot].place / 8).count(); };
    while (!is_live(edited.block.slots[slot]) || siblings() == BoxNode::least) ++slot;
    drop_slot(edited.block, slot);
    --edited.head.live;
    CHECK_FALSE(edited.opens());
    // Free, it is in no place but the list.
    ++edited.head.live;
    give_back_slot(edited.block, slot);
    CHECK(edited.opens());
}

TEST_CASE("scene: the root of a moving scene may have one child only if that is an instance") {
    MadeScene made(14, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    REQUIRE(insert(made.scene, {}));
    CHECK(EditedBlock(made.scene.bytes()).opens());
    for (int i = 1; i < 5; ++i) REQUIRE(insert(made.scene, {}));
    EditedBlock edited(made.scene.bytes());
    REQUIRE(edited.head.levels == 1);
    const std::uint32_t leaf = edited.head.root, root = take_node(edited.block);
    put_child(edited.block, 1, root, 0, edited.block.node(leaf).bounds(), leaf);
    edited.head.root = root;
    edited.head.levels = 2;
    CHECK_FALSE(edited.opens());
}

TEST_CASE("scene: an old box of a moving scene may reach the ends of the world and no farther") {
    constexpr std::int32_t most = most_world_steps;
    const std::vector<std::byte> bytes = large_scene(true);
    const StepsBox all = {{-most, -most, -most}, {most, most, most}};
    const auto opens_with = [&](const StepsBox& box) {
        EditedBlock edited(bytes);
        set_old_box(edited, box);
        const std::uint32_t at = edited.block.parent[leaf_of(edited.block)];
        renew_ancestors(edited.block, at / 8);
        return edited.opens();
    };
    CHECK(opens_with(all));
    CHECK(opens_with({{5, 5, 5}, {5, 5, 5}}));
    for (int k = 0; k < 3; ++k) {
        CAPTURE(k);
        StepsBox low = all, high = all, inverted = all;
        --low.low[k];
        ++high.high[k];
        inverted.low[k] = 6;
        inverted.high[k] = 5;
        CHECK_FALSE(opens_with(low));
        CHECK_FALSE(opens_with(high));
        CHECK_FALSE(opens_with(inverted));
    }
}

TEST_CASE("scene: a moving instance whose scale is out of range is refused with the box that fits") {
    MadeScene made(4, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    for (int i = 0; i < 2; ++i) REQUIRE(insert(made.scene, {}));
    EditedBlock edited(made.scene.bytes());
    for (const float scale : {0x1p-100f, 0.5f}) {
        set_scale(edited, 1, scale);
        CHECK(edited.opens());
    }
    for (const float scale : {0x1.fffffep-101f, 0x1p-149f, 0.0f}) {
        CAPTURE(scale);
        set_scale(edited, 1, scale);
        CHECK_FALSE(edited.opens());
    }
}

TEST_CASE("scene: an empty moving scene opens after a repack") {
    MadeScene made(4, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    repack(made.scene);
    REQUIRE(EditedBlock(made.scene.bytes()).head.packed_area == 1.0f);
    CHECK(EditedBlock(made.scene.bytes()).opens());
}

TEST_CASE("scene: a moving scene opens after its largest instance has left and the others were repacked") {
    MadeScene made(4, -12, cubes_and_tile().meshes, cubes_and_tile().tiles);
    const InstanceHandle large = *insert(made.scene, {{{}, {}, 64.0f}});
    REQUIRE(insert(made.scene, {}));
    REQUIRE(remove(made.scene, large) == QueryStatus::ok);
    repack(made.scene);
    CHECK(EditedBlock(made.scene.bytes()).opens());
}

}  // namespace
}  // namespace espalier::tests::borders_test
