// Embree's point query, asked for what Espalier answers. Compiled where Embree is installed.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

struct EmbreePoints {
    /// Returns how many triangles are within the radius. Embree hands over the triangles near the sphere; their
    /// distance is computed here, in float32, as its users do.
    std::function<std::size_t(Vec3 center, float radius)> count_within;
    std::function<float(Vec3 point)> closest_distance;
};
EmbreePoints embree_points(const Mesh& mesh);

}  // namespace espalier::bench
