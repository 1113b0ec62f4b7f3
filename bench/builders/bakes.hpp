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

// The queries that trees are compared by: rays, and pairs of a mesh with itself.

struct QueryCounts {
    std::size_t rays = 100'000;
    std::size_t poses = 1'000;
};

/// What the queries of one blob did, the same on every machine.
struct Work {
    QueryCounters rays;
    PairCounters pairs;
    std::uint64_t answers = 0;  ///< a digest of them, the same for every tree over one mesh
    std::size_t touching_poses = 0;
};

struct Seconds {
    double rays = 0.0;
    double pairs = 0.0;
};

/// Incoherent rays, and poses of a second mesh of the same kind.
class Queries {
public:
    /// The poses are searched with the blob, which is made from the mesh.
    Queries(const tests::Mesh& mesh, const Blob& blob, const QueryCounts& counts);

    [[nodiscard]] Work count(const Blob& blob) const;
    /// Runs all queries once, in processor time.
    [[nodiscard]] Seconds time(const Blob& blob) const;

private:
    std::vector<Ray> rays_;
    std::vector<Transform> poses_;
};

// Trees over one mesh, and blobs made from them.

struct TimedTree {
    baker::BinaryTree tree;
    double seconds = 0.0;  ///< to make it
};

/// A blob and its bytes.
struct BuiltBlob {
    std::vector<std::byte> bytes;
    Blob blob;
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

    [[nodiscard]] BuiltBlob bake(const baker::BinaryTree& tree) const;

private:
    tests::Mesh mesh_;
    baker::LatticeMesh lattice_mesh_;
    baker::BuildSettings settings_;
};

}  // namespace espalier::bench
