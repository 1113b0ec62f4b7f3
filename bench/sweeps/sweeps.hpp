// Shapes that move through a mesh, as Espalier and its peers take them.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

/// A shape that moves from anywhere in or near the mesh's box to anywhere there.
struct Moving {
    Vec3 start, way;
    OrientedBox box;             ///< the hull of the vertices, if there are eight; its half axes are perpendicular
    std::vector<Vec3> local;     ///< vertices, relative to the start
    std::vector<Vec3> vertices;  ///< in the world
};

/// Writes for each shape the share of the way up to the first contact, 1 if there is none.
using Sweeps = std::function<void(std::span<const Moving> shapes, std::span<float> contacts)>;

// Those of peers over their own triangle meshes, each where it is there. No shape has a margin. The mesh outlives them.
Sweeps bullet_sweeps(const Mesh& mesh, std::span<const Moving> shapes);
Sweeps box3d_sweeps(const Mesh& mesh, std::span<const Moving> shapes);

}  // namespace espalier::bench
