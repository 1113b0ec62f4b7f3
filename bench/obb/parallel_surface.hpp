// A second mesh whose surface runs along that of the first, at a distance: where oriented boxes save most.
#pragma once

#include <espalier/transform.hpp>

#include "../rays.hpp"

namespace espalier::bench {

struct ParallelSurface {
    Mesh mesh;       ///< turned at random, so that the boxes of the two meshes have different axes
    Transform pose;  ///< turns it back
};

/// Moves each vertex by `gap` along the mean of the normals of the triangles there. The two surfaces touch where the
/// first one has another part within the gap.
[[nodiscard]] ParallelSurface parallel_surface_of(const Mesh& mesh, double gap);

}  // namespace espalier::bench
