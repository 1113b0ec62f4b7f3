// All queries but batches of rays. An instruction set includes before how it prepares a ray, and its slab test of
// packed nodes.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/instruction_sets/queries.hpp>
#include <runtime/traversal/alone.hpp>
static_assert(true);  // ends clangd's preamble, which cannot include this file
#include <runtime/rays/prepare_ray_portable.inl>
#include <runtime/rays/slab_test.inl>
#endif

#include <runtime/traversal/traverse.inl>
#include <runtime/traversal/find.inl>
#include <runtime/proximity/squared_distance.inl>
#include <runtime/proximity/point_nodes.inl>
#include <runtime/proximity/pair_nodes.inl>
#include <runtime/instruction_sets/one_blob.inl>
#include <runtime/overlap/volume_queries.inl>
#include <runtime/pairs/search_pairs.inl>
#include <runtime/scenes/instance_walk.inl>
#include <runtime/moving_scenes/box_tree/self_join.inl>
#include <runtime/moving_scenes/box_tree/steps_boxes.inl>
#include <runtime/moving_scenes/walks.inl>
