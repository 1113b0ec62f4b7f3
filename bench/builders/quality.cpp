#include "quality.hpp"

#include <algorithm>

namespace espalier::bench {
namespace {

double volume(const baker::BinaryNode& node) {
    double product = 1.0;
    for (int axis = 0; axis < 3; ++axis) product *= double(node.hi[axis]) - double(node.lo[axis]);
    return product;
}

unsigned height(const baker::BinaryTree& tree, std::size_t node) {
    if (tree.nodes[node].is_leaf()) return 0;
    return 1 + std::max(height(tree, baker::BinaryTree::left_of(node)), height(tree, tree.right_of(node)));
}

}  // namespace

BinaryTreeQuality quality_of(const baker::BinaryTree& tree) {
    BinaryTreeQuality quality;
    double volumes = 0.0;
    for (std::size_t i = 0; i < tree.node_count(); ++i) {
        const baker::BinaryNode& node = tree.nodes[i];
        (node.is_leaf() ? quality.leaf_areas : quality.inner_areas) += node.half_area();
        volumes += volume(node);
    }
    const baker::BinaryNode& root = tree.nodes[0];
    quality.inner_areas /= root.half_area();
    quality.leaf_areas /= root.half_area();
    if (volume(root) > 0.0) quality.volumes = volumes / volume(root);
    quality.height = height(tree, 0);
    return quality;
}

}  // namespace espalier::bench
