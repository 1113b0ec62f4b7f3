// What each instruction set defines: the queries of rays, batches of rays, distances, overlaps, sweeps and two blobs.
#pragma once

#include <runtime/kernels/crossing.hpp>
#include <runtime/moving_scenes/queries.hpp>
#include <runtime/moving_scenes/box_tree/self_join.hpp>
#include <runtime/moving_scenes/box_tree/steps_boxes.hpp>
#include <runtime/moving_scenes/box_tree/slots.hpp>
#include <runtime/overlap/volume.hpp>
#include <runtime/pairs/queries.hpp>
#include <runtime/proximity/point_queries.hpp>
#include <runtime/rays/batch/batch.hpp>
#include <runtime/rays/queries.hpp>
#include <runtime/scenes/closest_ray.hpp>
#include <runtime/scenes/instance_walk.hpp>
#include <runtime/sweeps/queries.hpp>
#include <runtime/sweeps/shapes_in_lanes.hpp>
#include <runtime/traversal/fragments.hpp>
