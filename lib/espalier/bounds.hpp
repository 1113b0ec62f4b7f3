// Bounds of the whole asset that are tighter than its axis-aligned box, Blob::bounds(). The blob must have been baked
// with them (BakeOptions::bounds).
//
// Each call returns ok, not_open, or no_data for a blob that was baked without these bounds, in O(1). Any number of
// threads may query the same blob, and no call allocates. Numerics are described at the end of this file.
#pragma once

#include <espalier/blob.hpp>
#include <espalier/shapes.hpp>
#include <espalier/status.hpp>

namespace espalier {

/// Returns a sphere that contains all triangles and is close to the smallest one (Badoiu and Clarkson 2003).
Result<Sphere> bounding_sphere(const Blob& blob) noexcept;

/// Returns a box of small surface and any orientation that contains all triangles, found by a search over rotations
/// (Chang, Gorissen and Melchior 2011). Its half axes are perpendicular up to rounding.
Result<OrientedBox> oriented_bounds(const Blob& blob) noexcept;

/// Slabs along 13 fixed directions (Klosowski et al. 1998): lo[k] <= dot(directions[k], corner) <= hi[k].
struct KDop {
    static constexpr unsigned count = 13;
    static constexpr Vec3 directions[count] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {1, -1, 0},
                                               {1, 0, 1},  {1, 0, -1}, {0, 1, 1},  {0, 1, -1}, {1, 1, 1},
                                               {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};
    float lo[count] = {};
    float hi[count] = {};
};

/// Returns slabs that contain all triangles.
Result<KDop> k_dop_bounds(const Blob& blob) noexcept;

}  // namespace espalier

// Numerics. Bounds contain every corner of every triangle, as baked and as rounded to float. The stored bounds contain
// the baked corners exactly, and the floats are rounded outward, by some 2^-20 of the asset's size and of its distance
// from the world's origin. open() does not prove that the bounds in untrusted bytes contain anything: such bounds give
// wrong results, but safely.
