// The mesh that walks are compared on, its tree, and how many queries are made.
#pragma once

#include <cstddef>
#include <vector>

#include <espalier/blob.hpp>

#include "aabb_tree.hpp"

namespace espalier::bench {

struct TraversalOptions {
    unsigned leaf_triangles = 4;
    std::size_t poses = 100;
    std::size_t rays = 20'000;
    std::size_t rounds = 5;
};

struct Subject {
    Mesh mesh;  ///< at the common size
    TreeAndBlob built;
    Blob blob;
};

/// Prints a row for each class of poses, question and rule, and for Espalier's own queries. Throws std::runtime_error
/// if a rule has another answer than the others.
void measure_pairs(const Subject& subject, const TraversalOptions& options);
/// Prints a row for each order, and for Espalier's own query. Throws std::runtime_error if an order has another answer
/// than the others.
void measure_rays(const Subject& subject, const TraversalOptions& options);

}  // namespace espalier::bench
