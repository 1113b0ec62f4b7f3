// How far a place of the source is from the surface of a blob or a scene.
#pragma once

#include <limits>

#include <espalier/blob.hpp>
#include <espalier/scene.hpp>
#include <espalier/types.hpp>

namespace espalier::tools {

struct Measured {
    double distance = std::numeric_limits<double>::infinity();
    double error = 0.0;  ///< by how much the distance may be too large
};

/// Measures in the coordinates of the source.
Measured measure(const Blob& blob, const Vec3d& place);
Measured measure(const BakedScene& scene, const Vec3d& place);

/// Returns how far a distance that a query measures from a point may lie above the true one, near `distance`.
double measuring_error_at(const Blob& blob, Vec3 point, double distance);
double measuring_error_at(const BakedScene& scene, Vec3 point, double distance);
/// The same for one instance of the scene.
double measuring_error_at(const BakedScene& scene, const Instance& instance, Vec3 point, double distance);

}  // namespace espalier::tools
