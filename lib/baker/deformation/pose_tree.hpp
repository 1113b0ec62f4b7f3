// A tree that is built for several poses at once.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/deformation/pose_boxes.hpp>

namespace espalier::baker {

/// Builds a tree top down. Each split is the one along an axis of any pose that costs least over all poses, by the
/// surface area heuristic over planes between bins (Wald 2007) with the areas of PoseBoxes. The nodes have no boxes.
[[nodiscard]] BinaryTree build_over_poses(const PoseBoxes& boxes, std::uint32_t triangles,
                                          const BuildSettings& settings);

}  // namespace espalier::baker
