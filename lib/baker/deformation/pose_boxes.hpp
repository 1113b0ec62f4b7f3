// The boxes of triangles in several poses at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <baker/base/lane_box.hpp>
#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

/// The boxes of each triangle of a mesh, in the mesh's own pose and in others. The area of a set of boxes, one for each
/// pose, is the sum of their shares in the areas of the whole mesh's boxes. Each side counts one step more, so that no
/// box has no area.
class PoseBoxes {
public:
    using Boxes = std::span<const LaneBox>;

    PoseBoxes(const LatticeMesh& mesh, std::span<const std::vector<LatticePoint>> poses);

    [[nodiscard]] std::size_t pose_count() const { return weights_.size(); }
    [[nodiscard]] Boxes of(std::uint32_t triangle) const {
        return Boxes(boxes_).subspan(triangle * pose_count(), pose_count());
    }
    [[nodiscard]] float area(Boxes boxes) const;

private:
    std::vector<LaneBox> boxes_;
    std::vector<float> weights_;  ///< one over the area of the whole mesh, for each pose
};

/// Returns the box of a triangle whose corners are numbers of points.
[[nodiscard]] LaneBox box_of(const LatticeTriangle& triangle, std::span<const LatticePoint> points);

/// Enlarges each of some boxes to hold the one of the same pose.
inline void add(std::span<LaneBox> boxes, PoseBoxes::Boxes others) {
    for (std::size_t pose = 0; pose < boxes.size(); ++pose) boxes[pose].add(others[pose]);
}

}  // namespace espalier::baker
