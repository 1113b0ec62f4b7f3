// Positions as they were given and less an origin: in float64, so that they lose nothing until they are lattice points.
#pragma once

#include <cmath>
#include <span>

#include <espalier/bake.hpp>

namespace espalier::baker {

/// Returns the position of a mesh as it was given.
[[nodiscard]] Vec3d given_position(const MeshView& mesh, std::size_t number);

[[nodiscard]] inline bool is_finite(const Vec3d& point) {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

/// Positions less an origin.
class PositionsFromOrigin {
public:
    /// `as_float32`: positions are rounded to float32 then, as refit() takes those of all other poses.
    PositionsFromOrigin(const Vec3d& origin, bool as_float32) : origin_(origin), as_float32_(as_float32) {}

    /// Subtracts the origin, with one rounding in float64. What is beyond float32 becomes infinite.
    [[nodiscard]] Vec3d at(const Vec3d& given);
    /// Returns a bound on how far the rounding moved any finite position.
    [[nodiscard]] double moved() const;

private:
    [[nodiscard]] double subtract(double given, double origin, double& error) const;

    Vec3d origin_;
    bool as_float32_;
    double largest_square_ = 0.0;
};

}  // namespace espalier::baker
