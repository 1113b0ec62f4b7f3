// Third stage: a binary tree by the surface area heuristic.
#pragma once

#include <functional>

#include "binary_tree.hpp"
#include "lattice_mesh.hpp"

namespace espalier::baker {

struct BuildSettings {
    unsigned bins = 32;        ///< candidate planes per axis, for large nodes
    unsigned exact_below = 8;  ///< nodes with at most this many triangles try every split
    unsigned threads = 1;
    unsigned most_height = max_binary_height;  ///< the heuristic yields to balance where it would build higher
    std::function<void(double)> progress;      ///< share of triangles placed, 0..1; called from the calling thread
};

[[nodiscard]] BuildSettings build_settings(unsigned effort, unsigned threads);

/// Down to single triangles, at most most_height high, or as high as a balanced tree must be. The result depends on
/// the triangles and on the settings, but not on threads.
[[nodiscard]] BinaryTree build_sah(const LatticeMesh& mesh, const BuildSettings& settings);

}  // namespace espalier::baker
