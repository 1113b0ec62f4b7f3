// What is measured: how many rays, how often.
#pragma once

#include <cstddef>

#include "edge_rays.hpp"

namespace espalier::bench {

struct ExactnessOptions {
    std::size_t aimed = 50'000;  ///< rays at each kind of place
    std::size_t rays = 20'000;   ///< of which times are measured
    std::size_t rounds = 5;
    unsigned leaf_triangles = 4;
};

/// Prints a row for each system and kind of place: how many aimed rays pass between triangles. Throws
/// std::runtime_error if one passes Espalier.
void print_leaks(const SnappedMesh& snapped, const ExactnessOptions& options);

/// Prints a row for each kernel: the time of a test alone, and of a ray through one and the same tree.
void print_kernel_times(const SnappedMesh& snapped, const ExactnessOptions& options);

/// Prints a row for each lattice: bytes, error and the time of a ray.
void print_lattices(const Mesh& mesh, const ExactnessOptions& options);

}  // namespace espalier::bench
