// A mesh on the format's lattice, the baker's binary tree over it, and the blobs that are baked from it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <espalier/blob.hpp>

#include <baker/build/binary_tree.hpp>

#include "../rays.hpp"
#include "layouts.hpp"

namespace espalier::bench {

struct BakedBlob {
    std::vector<std::byte> bytes;
    Blob blob;
};

struct LadderSubject {
    Mesh mesh;  ///< at the common size; its corners are lattice points, its triangles in the order of the tree
    baker::BinaryTree binary;
    float margin = 0.0f;   ///< by how much boxes are larger than their triangles
    double step = 0.0;     ///< of the lattice
    BakedBlob fast;        ///< nodes of 16 children
    BakedBlob balanced;    ///< nodes of 8 children, and larger leaves
    BakedBlob small_blob;  ///< nodes of 8 children, and the largest leaves

    /// Returns a shape with its boxes.
    [[nodiscard]] BoxedShape boxed(const TreeShape& shape) const;
};

/// Builds as the baker does: binned SAH, then reinsertion. All trees and blobs have the same triangles. Throws
/// std::runtime_error with the mesh's name.
[[nodiscard]] LadderSubject make_subject(Mesh mesh);

/// Returns cubes around the corners of random triangles. Their sides are about a 64th of the mesh's largest side, and
/// all their coordinates are on the lattice.
[[nodiscard]] std::vector<Aabb> boxes_on_surface(const LadderSubject& subject, std::size_t count, std::uint64_t seed);

}  // namespace espalier::bench
