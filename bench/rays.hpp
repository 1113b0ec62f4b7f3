// The rays that everything is measured with: fixed seeds, so that every system answers the same questions.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/ray.hpp>

#include "../tests/support/mesh.hpp"

namespace espalier::bench {

using tests::Mesh;

/// 512 x 512 pinhole views from three sides, row by row.
std::vector<Ray> coherent_rays(const Mesh& mesh);

/// From a sphere of 1.2 radii around the mesh towards random points in its box.
std::vector<Ray> incoherent_rays(const Mesh& mesh, std::size_t count);

}  // namespace espalier::bench
