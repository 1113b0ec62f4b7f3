// Whether two triangles of a common integer grid share a point: decided in integers, touching counts. Sides of each
// other's planes first, then the order of four points on the line where the planes cross, as Devillers and Guigue found
// it (Faster triangle-triangle intersection tests, INRIA 2002).
#pragma once

#include <cstdint>

#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Coordinates that belong to one another must differ by less than this.
inline constexpr std::int64_t triangle_pair_reach = std::int64_t{1} << 39;

/// Whether the closed triangles share a point, exactly.
[[nodiscard]] bool triangles_meet(const IntegerTriangle& p, const IntegerTriangle& q) noexcept;
/// Not inlined: the triangles in integers must not lie on the stack below other kernels.
[[nodiscard]] bool triangles_meet(const LatticeTriangle& p, const LatticeTriangle& q) noexcept;

}  // namespace espalier::detail
