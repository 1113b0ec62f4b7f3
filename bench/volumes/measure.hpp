// The same queries in trees of each kind of volume.
#pragma once

#include <cstddef>

#include "../rays.hpp"

namespace espalier::bench {

struct VolumeOptions {
    unsigned leaf_triangles = 8;
    std::size_t rays = 10'000;
    std::size_t balls = 5'000;
    std::size_t poses = 60;
    std::size_t rounds = 5;
};

/// Prints a row for each kind of volume, and for Espalier's own queries. Throws std::runtime_error if a kind has other
/// answers than the others.
void measure_volumes(Mesh mesh, const VolumeOptions& options);

}  // namespace espalier::bench
