// Blobs, scenes and poses that tests of C share.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <espalier/scene.hpp>

#include "support/blobs/test_blobs.hpp"

namespace espalier::tests {

/// Has every optional section.
OpenedBlob blob_with_everything(Profile profile);
OpenedBlob blob_with_copies();

std::vector<Instance> some_instances();
/// Bakes a scene of five meshes, one of each profile and one with duplicate references, and a tile of the same meshes.
std::vector<std::byte> bake_instances(std::span<const Instance> instances);

}  // namespace espalier::tests
