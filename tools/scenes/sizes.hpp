// What meshes take as instances, and what they would take in one blob.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <espalier/blob.hpp>

namespace espalier::tools {

/// Returns about how many bytes the triangles of a blob take as a part of a larger blob: its own leaves and what it
/// stores for each triangle, with its share of nodes that are four fifths full.
double bytes_as_part(std::span<const std::byte> bytes, const Blob& blob);

/// Returns how many bytes a blob for merged meshes adds to a scene, without the bytes of the meshes.
double bytes_of_merging();

/// Returns how many bytes a mesh with that many instances adds to a scene, with a node for four instances.
double bytes_as_instances(const Blob& blob, std::uint64_t instances);

}  // namespace espalier::tools
