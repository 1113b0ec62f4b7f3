#include <baker/deformation/steered_tree.hpp>

#include <cstring>
#include <utility>

#include <baker/deformation/pose_boxes.hpp>
#include <baker/deformation/pose_tree.hpp>

namespace espalier::baker {

namespace {

/// Renews the boxes of all nodes. Children come after their parents.
void refit(BinaryTree& tree, const LatticeMesh& mesh, const std::vector<LatticePoint>& points) {
    for (std::size_t node = tree.node_count(); node-- != 0;) {
        BinaryNode& here = tree.nodes[node];
        LaneBox box;
        if (here.is_leaf()) {
            box = box_of(mesh.triangles[tree.triangles[here.first]], points);
        } else {
            box = tree.nodes[BinaryTree::left_of(node)].box();
            box.add(tree.nodes[tree.right_of(node)].box());
        }
        std::memcpy(here.lo, &box.lo, sizeof here.lo);
        std::memcpy(here.hi, &box.hi, sizeof here.hi);
    }
}

/// Each side counts one step more, so that no box has no area.
double cost_of(const BinaryTree& tree) {
    const auto area = [](const BinaryNode& node) {
        const double x = double(node.hi[0]) - double(node.lo[0]) + 1.0;
        const double y = double(node.hi[1]) - double(node.lo[1]) + 1.0;
        const double z = double(node.hi[2]) - double(node.lo[2]) + 1.0;
        return x * y + y * z + z * x;
    };
    double sum = 0.0;
    for (std::size_t node = 0; node < tree.node_count(); ++node) sum += area(tree.nodes[node]);
    return sum / area(tree.nodes[0]);
}

}  // namespace

BinaryTree make_steered_tree(const TreeMaker& make_tree, const LatticeMesh& mesh,
                             std::span<const std::vector<LatticePoint>> poses, const BuildSettings& settings) {
    BinaryTree best = make_tree(mesh, settings);
    if (poses.empty()) return best;
    const auto cost_over_poses = [&](BinaryTree& tree) {
        double cost = 0.0;
        for (const std::vector<LatticePoint>& pose : poses) {
            refit(tree, mesh, pose);
            cost += cost_of(tree);
        }
        refit(tree, mesh, mesh.vertices);
        return cost + cost_of(tree);
    };
    double least = cost_over_poses(best);
    const auto keep_if_better = [&](BinaryTree tree) {
        const double cost = cost_over_poses(tree);
        if (cost >= least) return;
        least = cost;
        best = std::move(tree);
    };
    LatticeMesh posed = mesh;
    for (const std::vector<LatticePoint>& pose : poses) {
        posed.vertices = pose;
        keep_if_better(make_tree(posed, settings));
    }
    keep_if_better(
        build_over_poses(PoseBoxes(mesh, poses), static_cast<std::uint32_t>(mesh.triangles.size()), settings));
    return best;
}

}  // namespace espalier::baker
