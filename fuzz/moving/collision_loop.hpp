// Whether triangles of two instances touch, by a loop over the meshes of both in public calls.
#pragma once

#include <espalier/scene.hpp>

namespace espalier::fuzz {

/// A mesh or a tile at a place.
struct PlacedPart {
    const Blob* mesh;  ///< null for a tile
    const BakedScene* tile;
    Transform transform;
};
/// Returns an instance of the world as its part.
PlacedPart part_of(const Instance& instance);
/// Returns an instance of a mesh in a baked scene as its part.
PlacedPart part_in(const BakedScene& scene, InstanceId instance, const Blob& mesh);

/// What a loop finds out: `unknown` if a pair of meshes is refused before the loop would come to others that touch, or
/// after it.
enum class Verdict { apart, touching, refused, unknown };

/// Returns whether two parts touch. Meshes of a tile are seen from the tile's local space.
Verdict touches(const PlacedPart& a, const PlacedPart& b);

}  // namespace espalier::fuzz
