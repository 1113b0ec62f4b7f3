// Meshes cut into parts that are baked apart on one lattice: what tiles of a terrain and halves of a body are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <espalier/bake.hpp>

#include "mesh.hpp"

namespace espalier::tests {

struct Split {
    struct Part {
        Mesh mesh;                               ///< with the positions that it uses and no others
        std::vector<std::uint32_t> in_whole;     ///< for each position, which one of the whole it is
        std::vector<std::uint32_t> of_triangle;  ///< for each triangle, which one of the whole it is
    };

    std::string name;
    Mesh whole;
    bool closed = false;       ///< else a height field over x and y, rising along z
    std::vector<Vec3> inside;  ///< points deep inside a closed mesh
    std::vector<Part> parts;
    BakeOptions options;  ///< fixes the step; the profile differs from split to split
};

/// Split number 0, 1, ...: a closed mesh or a terrain of any size and place, cut by a plane, into tiles, or at random,
/// so that parts meet along a line, around corners, or nearly everywhere. No triangle vanishes on the lattice.
Split make_split(std::uint32_t number);

}  // namespace espalier::tests
