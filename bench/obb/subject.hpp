// The mesh that boxes are fitted to, and how much is measured.
#pragma once

#include <cstddef>

#include <espalier/blob.hpp>

#include "../traversal/aabb_tree.hpp"

namespace espalier::bench {

struct ObbOptions {
    std::size_t set_triangles = 40'000;  ///< of all measured sets of one size together, at most
    std::size_t poses = 60;
    std::size_t parallel_poses = 3;
    double gap = 0.005;  ///< between parallel surfaces, as a share of the bounding sphere's radius
    std::size_t rounds = 3;
};

struct ObbSubject {
    Mesh mesh;  ///< at the common size
    TreeAndBlob built;
    Blob blob;
};

/// Builds the tree with one triangle in each leaf. Throws std::runtime_error with the mesh's name.
[[nodiscard]] ObbSubject make_obb_subject(Mesh mesh);

/// Prints a row for each size of set and each fit.
void measure_fits(const ObbSubject& subject, const ObbOptions& options);
/// Prints a row for each class of poses, question and kind of tree. Throws std::runtime_error if a tree has other
/// answers than the others.
void measure_trees(const ObbSubject& subject, const ObbOptions& options);

}  // namespace espalier::bench
