// Whether the triangles of two placed parts touch, each a mesh or a tile.
#pragma once

#include <espalier/status.hpp>
#include <espalier/transform.hpp>
#include <runtime/pairs/contacts.hpp>
#include <runtime/scenes/instances.hpp>

namespace espalier::detail {

/// A mesh or a tile at a place.
struct PlacedPart {
    MeshOrTile part;
    Transform transform;
};

/// Returns ok if triangles of the two parts touch, not_found, work_limit, or why overlaps() refuses their meshes.
QueryStatus find_collision(const PlacedPart& a, const PlacedPart& b, PairWork& work);

}  // namespace espalier::detail
