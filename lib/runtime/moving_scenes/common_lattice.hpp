// The part of the world's lattice that instances of a moving scene share: rays are rounded for it once.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <espalier/scenes/moving_scene.hpp>
#include <runtime/moving_scenes/box_tree/block.hpp>

namespace espalier::detail {

/// The number before an instance was on the common lattice.
inline constexpr std::uint8_t no_region = 0;
/// The largest number; a region twice as large would have more steps than a Lattice may.
inline constexpr std::uint8_t most_region = 7;

/// Returns a region that instances may share: a cube around the origin of a view. Number 1 reaches 2^17 steps to each
/// side, so that rays that begin in it have the finest grid, and each number twice as far as the one before. Were it as
/// small as the instances, each that comes or goes would change how rays are rounded for the others.
Lattice common_region(const BlockHead& head, std::uint8_t number);

/// Returns the number of the least region, no smaller than the head's, that holds the part of a slot at its place on
/// the lattice; the head's if none does. A slot that counts from another origin than 0 has the largest: a view near it
/// has it in a cube around itself, wherever it was placed from.
std::uint8_t common_region_with(const MovingScene& scene, const InstanceSlot& slot);

}  // namespace espalier::detail
