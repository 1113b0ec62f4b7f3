// Whether two triangles of a common integer grid share a point: decided in integers, touching counts. Sides of each
// other's planes first, then the order of four points on the line where the planes cross, as Devillers and Guigue found
// it (Faster triangle-triangle intersection tests, INRIA 2002).
#pragma once

#include <cstdint>

#include <runtime/lattice_triangle.hpp>
#include <runtime/wide_integer.hpp>

namespace espalier::detail {

/// Corners on an integer grid. Triangles without area, segments and points, are triangles too.
struct IntegerTriangle {
    Integer3 corner[3];
};

ESPALIER_SHARED_CODE inline Integer3 operator-(const Integer3& a, const Integer3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// Coordinates that belong to one another must differ by less than this.
inline constexpr std::int64_t triangle_pair_reach = std::int64_t{1} << 39;

ESPALIER_SHARED_CODE inline IntegerTriangle integer_triangle(const LatticeTriangle& t) {
    IntegerTriangle result;
    for (int corner = 0; corner < 3; ++corner)
        result.corner[corner] = {t.corner[corner][0], t.corner[corner][1], t.corner[corner][2]};
    return result;
}

/// Whether the closed triangles share a point, exactly.
[[nodiscard]] bool triangles_meet(const IntegerTriangle& p, const IntegerTriangle& q) noexcept;

}  // namespace espalier::detail
