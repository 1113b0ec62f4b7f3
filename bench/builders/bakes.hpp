// How good a binary tree is, before it becomes a blob.
#pragma once

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

#include "builders.hpp"

namespace espalier::bench {

/// Sums are over the root's own value.
struct BinaryTreeQuality {
    /// Of the areas of nodes with children: how many of them a random line through the root's box is expected to meet.
    double inner_areas = 0.0;
    /// Of the areas of leaves, which hold a triangle each: how many of them such a line is expected to meet.
    double leaf_areas = 0.0;
    /// Of the volumes of all nodes; nothing where the root has none.
    std::optional<double> volumes;
    unsigned height = 0;

    /// The cost of the surface area heuristic (Goldsmith, Salmon 1987; MacDonald, Booth 1990) with a price of 1 for a
    /// node and for a triangle.
    [[nodiscard]] double sah_cost() const { return inner_areas + leaf_areas; }
};

/// The tree must have a triangle at least.
[[nodiscard]] BinaryTreeQuality quality_of(const baker::BinaryTree& tree);

// Trees over one mesh, and blobs made from them.

struct TimedTree {
    baker::BinaryTree tree;
    double seconds = 0.0;  ///< to make it
};

struct TimedBlob : BakedBlob {
    double seconds = 0.0;  ///< of the bake without the tree
};

/// A mesh on its lattice, with the settings of a bake in profile `fast` on one thread at effort `normal`. Everything is
/// timed in processor time. Calls throw std::runtime_error with the mesh's name.
class Bakes {
public:
    explicit Bakes(tests::Mesh mesh);

    [[nodiscard]] const tests::Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const baker::LatticeMesh& lattice_mesh() const { return lattice_mesh_; }
    [[nodiscard]] const baker::BuildSettings& settings() const { return settings_; }

    /// Builds a tree `rounds` times, and more often where that takes less than a tenth of a second; no build begins
    /// after a second and a half. The median time counts.
    [[nodiscard]] TimedTree build(const NamedBuilder& builder, std::size_t rounds) const;

    /// Moves the subtrees of 8 triangles or more of a copy, once, as the baker does at effort `normal`.
    [[nodiscard]] TimedTree reinsert(const baker::BinaryTree& tree) const;

    [[nodiscard]] TimedBlob bake(const baker::BinaryTree& tree) const;

private:
    tests::Mesh mesh_;
    baker::LatticeMesh lattice_mesh_;
    baker::BuildSettings settings_;
};

}  // namespace espalier::bench
