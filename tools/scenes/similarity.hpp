// A placement as a Transform, where a rotation, a uniform scale and a translation suffice.
#pragma once

#include <array>
#include <optional>

#include <espalier/transform.hpp>

#include "base/placement.hpp"

namespace espalier::tools {

/// A box around the points of a mesh. Without points, `low` is above `high`.
struct PointBox {
    std::array<double, 3> low;
    std::array<double, 3> high;
};

/// A Transform in place of a placement, and the largest distance between the two over the points of a box. It is that
/// at a corner of the box, since the distance is convex.
struct FittedTransform {
    Transform transform;
    double error = 0.0;
};

/// Returns the Transform of a placement, or nothing if there is none whose error is due to rounding alone: the
/// placement shears, mirrors or scales unequally, or is out of range.
std::optional<FittedTransform> fit_transform(const Placement& placement, const PointBox& box);

/// Returns the Transform that only moves by the placement's offset, for a mesh with the rest of it in its vertices.
FittedTransform fit_translation(const std::array<double, 3>& offset);

/// Returns the scale of a placement: the root of the mean square of its columns' lengths.
double scale_of(const Placement& placement);

}  // namespace espalier::tools
