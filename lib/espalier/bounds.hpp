// Bounds of the whole asset that are tighter than its axis-aligned box (Blob::bounds_min, bounds_max): for blobs that
// were baked with them. Cheap first tests for whoever holds many assets.
//
// Numbers. Each holds every corner of every triangle, as baked and as rounded to float: what is stored holds the baked
// ones exactly, and the floats are rounded outward, by some 2^-20 of the asset's size and of its distance from the
// world's origin. Of bytes that a stranger made `open` does not prove that they hold anything: such bounds give wrong
// answers, safely.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>

namespace espalier {

/// A sphere close to the smallest one (Badoiu, Clarkson 2003). False, and `sphere` untouched, when the blob has none.
bool bounding_sphere(const Blob& blob, Sphere& sphere) noexcept;

/// A box of little surface, in any orientation (a search over rotations: Chang, Gorissen, Melchior 2011). Its half axes
/// are perpendicular up to rounding. False, and `box` untouched, when the blob has none.
bool oriented_bounds(const Blob& blob, OrientedBox& box) noexcept;

/// Slabs along 13 fixed directions (Klosowski et al. 1998): lo[k] <= dot(directions[k], corner) <= hi[k].
struct KDop {
    static constexpr unsigned count = 13;
    static constexpr Vec3 directions[count] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                               {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                               {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    float lo[count] = {};
    float hi[count] = {};
};

/// False, and `k_dop` untouched, when the blob has none.
bool k_dop_bounds(const Blob& blob, KDop& k_dop) noexcept;

/// True only if the sphere, or box, touches no triangle: judged by whichever bounds the blob carries and by its
/// axis-aligned box, without a look at the tree. False says nothing. NaN, a negative radius and an empty box touch
/// nothing; any other bit pattern is safe.
[[nodiscard]] bool is_outside_bounds(const Blob& blob, const Sphere& sphere) noexcept;
[[nodiscard]] bool is_outside_bounds(const Blob& blob, const Box& box) noexcept;

}  // namespace espalier
