// Rays and distances of one blob, but for what the instruction sets have of their own.
#ifndef ESPALIER_IN_INSTRUCTION_SET  // parsed alone
#include <runtime/instruction_sets/queries.hpp>
#include <runtime/traversal/alone.hpp>
static_assert(true);  // ends clangd's preamble, which cannot include this file
#include <runtime/rays/prepare_ray_portable.inl>
#include <runtime/rays/slab_test.inl>
#include <runtime/traversal/traverse.inl>
#include <runtime/traversal/find.inl>
#include <runtime/proximity/squared_distance.inl>
#include <runtime/proximity/point_nodes.inl>
#include <runtime/proximity/pair_nodes.inl>
#endif

#include <runtime/rays/plain_slab_test.inl>
#include <runtime/rays/leaf_filter.inl>
#include <runtime/rays/closest.inl>
#include <runtime/rays/in_order.inl>
#include <runtime/proximity/point_queries.inl>
#include <runtime/proximity/pair_queries.inl>
#include <runtime/sweeps/time_bounds.inl>
#include <runtime/sweeps/swept_box.inl>
#include <runtime/sweeps/beside_way.inl>
#include <runtime/sweeps/capsule_bounds.inl>
#include <runtime/sweeps/box_bounds.inl>
#include <runtime/sweeps/hull_bounds.inl>
#include <runtime/sweeps/leaf_bounds.inl>
#include <runtime/sweeps/first_contact.inl>
