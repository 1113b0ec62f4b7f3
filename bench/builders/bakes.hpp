// Trees over one mesh, and blobs made from them.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/blob.hpp>

#include <baker/build/binary_tree.hpp>
#include <baker/build/settings.hpp>
#include <baker/quantise/lattice_mesh.hpp>

#include "../../tests/support/meshes/mesh.hpp"
#include "builders.hpp"

namespace espalier::bench {

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
