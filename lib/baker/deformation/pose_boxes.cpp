#include <baker/deformation/pose_boxes.hpp>

namespace espalier::baker {

namespace {

float half_area(const LaneBox& box) {
    const float x = box.hi[0] - box.lo[0] + 1.0f, y = box.hi[1] - box.lo[1] + 1.0f, z = box.hi[2] - box.lo[2] + 1.0f;
    return x * y + y * z + z * x;
}

}  // namespace

LaneBox box_of(const LatticeTriangle& triangle, std::span<const LatticePoint> points) {
    LaneBox box;
    for (const std::uint32_t corner : triangle.corners) {
        const LatticePoint& point = points[corner];
        box.add(Lanes{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0.0f});
    }
    return box;
}

PoseBoxes::PoseBoxes(const LatticeMesh& mesh, std::span<const std::vector<LatticePoint>> poses) {
    const std::size_t count = poses.size() + 1;
    boxes_.reserve(mesh.triangles.size() * count);
    std::vector<LaneBox> all(count);
    for (const LatticeTriangle& triangle : mesh.triangles) {
        boxes_.push_back(box_of(triangle, mesh.vertices));
        for (const std::vector<LatticePoint>& pose : poses) boxes_.push_back(box_of(triangle, pose));
        add(all, Boxes(boxes_).last(count));
    }
    for (const LaneBox& box : all) weights_.push_back(1.0f / half_area(box));
}

float PoseBoxes::area(Boxes boxes) const {
    float sum = 0.0f;
    for (std::size_t pose = 0; pose < boxes.size(); ++pose) sum += weights_[pose] * half_area(boxes[pose]);
    return sum;
}

}  // namespace espalier::baker
