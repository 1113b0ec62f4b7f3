// The rays that everything is measured with: fixed seeds, so that every system answers the same questions.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/ray.hpp>

#include "../tests/support/meshes/mesh.hpp"

namespace espalier::bench {

using tests::Mesh;

struct BoundingSphere {
    Vec3 center;
    float radius = 0.0f;
};
/// Around the box of all vertices that a triangle names.
BoundingSphere bounding_sphere(const Mesh& mesh);

/// Scales the mesh by a power of two, which is exact, so that the largest side of its box is at least 128 and below
/// 256, and answers with the factor. Bullet pads boxes by a whole unit and other engines have absolute thresholds too:
/// at the size of a room they are measured at their best. The others do not care.
double bring_to_common_size(Mesh& mesh);

/// 512 x 512 pinhole views from three sides, row by row. Rays have length 1 and no end.
std::vector<Ray> coherent_rays(const Mesh& mesh);

/// From a sphere of 1.2 radii around the mesh towards random points in its box. Rays have length 1 and no end.
/// The any-hit queries ask these too: a ray starts outside of the mesh and ends nowhere, so that most of them hit. It
/// is not the short ray from a surface to a light.
std::vector<Ray> incoherent_rays(const Mesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace espalier::bench
