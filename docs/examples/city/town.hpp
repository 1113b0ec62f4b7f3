// A town that is generated: meshes, and where their instances stand.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/espalier.hpp>

#include "solid.hpp"

namespace city {

/// What an instance is. Its user number, and the bit of its mask.
enum class Kind : std::uint32_t { ground, house, tree, lamp };

constexpr std::uint32_t mask_of(Kind kind) { return 1u << static_cast<std::uint32_t>(kind); }

struct Town {
    std::vector<Solid> meshes;
    std::vector<espalier::Instance> instances;  ///< Instance::mesh is the index in `meshes`
};

/// The side of the town and of a tile of its ground, and the distance between streets, in metres.
inline constexpr int town_side = 1024;
inline constexpr int tile_side = 128;
inline constexpr int street_distance = 64;

/// Returns the height of the ground in units, at a place in metres.
int ground_height(int x, int y);

/// Makes the town. The ground is a mesh for each tile, in one space and without rotation: all tiles lie on one lattice.
/// Houses, trees and lamps are a few meshes that stand in many places.
Town make_town();

}  // namespace city
