// A scene as seen from a shape: where its tree is, and how far rounding may move the shape.
#pragma once

#include <espalier/scene.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// From farther away, in steps, the slack exceeds the scene: every box may be met.
inline constexpr float farthest_reach = 0x1p42f;

/// Returns the box around a shape that only sweeps take. Those around other shapes are in espalier/scene.hpp.
ShapeBounds bounds_of(const ConvexHull& hull) noexcept;

/// Returns whether the radius of a shape, if it has one, is finite.
template <class Shape>
bool has_finite_radius(const Shape& shape) {
    if constexpr (requires { shape.radius; }) return is_finite(shape.radius);
    return true;
}

/// The tree of a scene, as seen from the anchor of a shape.
struct SceneAround {
    float offset[3];  ///< of the tree's lattice point 0 0 0 from the anchor
    float reach;      ///< at least each coordinate, from the anchor, of the scene's corners and of the shape's way
    /// More than to_local(), the lattice of any instance and the arithmetic of the walk move any point of the shape
    /// along an axis (docs/numerics.md, Scenes).
    float slack;
};

/// Returns the scene as seen from a shape. `magnitude` is at least the length of the way that it moves.
SceneAround scene_around(const SceneData& scene, const ShapeBounds& bounds, float magnitude = 0.0f);

}  // namespace espalier::detail
