// Volumes against a blob. The triangles are a surface: a sphere inside a closed mesh that touches none overlaps none.
//
// Numbers. Centre and radius are rounded once onto a grid finer than the asset's lattice (docs/numerics.md); whether a
// triangle overlaps is then decided exactly, and touching counts.
// Arguments. Any bit pattern is safe. A NaN, a centre that is infinite or more than 2^120 lattice steps away, or a
// negative radius overlaps nothing, O(1); otherwise an infinite radius overlaps everything; radius 0 is a point.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/function_ref.hpp>
#include <espalier/shapes.hpp>
#include <espalier/types.hpp>

namespace espalier {

/// Whether any triangle overlaps the sphere.
[[nodiscard]] bool overlaps(const Blob& blob, const Sphere& sphere) noexcept;

/// Every overlapping triangle, in storage order, until the visitor answers stop. True when it saw them all.
/// The visitor must not throw. False at once, and nothing is visited, when blob.copy_count() is not 0.
bool for_each_overlap(const Blob& blob, const Sphere& sphere, FunctionRef<Visit(Triangle)> visit);

}  // namespace espalier
