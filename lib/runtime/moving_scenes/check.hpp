// The proof that a block is sound: every index in its range, a tree of equal depth, each live slot in it once, and
// every box that of what it holds.
#pragma once

#include <espalier/scenes/moving_scene.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// Returns whether every operation and query on the block is safe, and whether refit_boxes() leaves exact boxes in all
/// nodes. O(n); it writes nothing. The capacities have been checked.
bool is_sound(const SceneBlock& block);
/// Returns whether the slots of a sound block place the meshes and tiles of the scene, at the boxes that they have.
bool has_boxes_of_instances(const MovingScene& scene);

}  // namespace espalier::detail
