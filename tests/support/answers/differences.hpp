// One query, asked of every instruction set and of the public functions, against the loop over all triangles.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <espalier/blob.hpp>
#include <espalier/overlap.hpp>
#include <espalier/ray.hpp>

#include "support/loops/triangle_loop.hpp"

namespace espalier::tests {

/// What differs first, in bits; nothing when all agree. `hits` grows by the number of triangles that the ray hits. The
/// loop goes on as usual, whatever mode of float_mode.hpp the library is asked in.
std::optional<std::string> ray_difference(const Blob& blob, const TriangleLoop& loop, const Ray& ray,
                                          std::uint64_t& hits, unsigned float_mode = 0);

/// The same of the closest hit and any hit along a segment.
std::optional<std::string> segment_difference(const Blob& blob, const TriangleLoop& loop, const Segment& segment);

/// The same for overlaps, and for the closest point within the radius of the centre.
std::optional<std::string> sphere_difference(const Blob& blob, const TriangleLoop& loop, const Sphere& sphere,
                                             std::uint64_t& hits);

/// Whether an instruction set answers otherwise than the scalar path: for great numbers of queries without a loop.
std::optional<std::string> path_difference(const Blob& blob, const Ray& ray);
std::optional<std::string> path_difference(const Blob& blob, const Sphere& sphere);

}  // namespace espalier::tests
