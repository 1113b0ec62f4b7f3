// Shapes that move through a mesh, as Espalier and Bullet take them.
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

/// Bullet's convex sweep over its triangle mesh, where Bullet is installed: returns for each shape the share of the way
/// up to the first contact, 1 if there is none. No shape has a margin. The mesh outlives it.
std::function<void(std::span<const Moving> shapes, std::span<float> contacts)> bullet_sweeps(
    const Mesh& mesh, std::span<const Moving> shapes);

}  // namespace espalier::bench
