// Embree's point query, asked for what Espalier answers. Compiled where Embree is installed.
#pragma once

#include "../base.hpp"

namespace espalier::bench {

class EmbreePoints {
public:
    explicit EmbreePoints(const Mesh& mesh);
    ~EmbreePoints();
    EmbreePoints(const EmbreePoints&) = delete;
    EmbreePoints& operator=(const EmbreePoints&) = delete;

    /// How many triangles are within the radius. Embree hands over the triangles near the sphere; their distance is
    /// computed here, in float32, as its users do.
    [[nodiscard]] std::size_t count_within(Vec3 center, float radius) const;
    [[nodiscard]] float closest_distance(Vec3 point) const;

private:
    struct Scene;
    std::unique_ptr<Scene> scene_;
};

}  // namespace espalier::bench
