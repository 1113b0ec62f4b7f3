// Decides which of the triangles around an edge or a vertex that a ray meets count as crossings.
#pragma once

#include <cstdint>

#include <runtime/kernels/small_ray_triangle.hpp>
#include <runtime/lattice/round_ray.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Returns whether a ray that hits the triangle still hits it after its origin moves a little along x, far less along
/// y, and far less again along z (Edelsbrunner, Mücke 1990). The moved ray meets no edge, so that of the triangles on
/// both sides of one it hits a single one.
ESPALIER_NOINLINE inline bool is_crossing(const IntegerRay& ray, const LatticeTriangle& triangle) {
    std::int32_t corner[3][3];  // from the origin, in units of 2^-fraction_bits
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned k = 0; k < 3; ++k)
            corner[i][k] = triangle.corner[i][k] * (1 << ray.fraction_bits) - ray.origin[k];
    bool any_positive = false, any_negative = false;
    const std::int32_t *q = corner[1], *r = corner[2];
    for (unsigned i = 0; i < 3; ++i) {
        const small_ray_triangle::Words weight =
            small_ray_triangle::dot(ray.direction, small_ray_triangle::cross(q, r));
        bool is_zero = (weight.word[0] | weight.word[1] | weight.word[2]) == 0;
        bool is_negative = weight.is_negative();
        const std::int32_t side[3] = {r[0] - q[0], r[1] - q[1], r[2] - q[2]};
        const small_ray_triangle::CrossProduct gradient = small_ray_triangle::cross(ray.direction, side);
        for (unsigned k = 0; k < 3 && is_zero; ++k) {
            is_zero = gradient.coordinate[k] == 0;
            is_negative = gradient.coordinate[k] < 0;
        }
        any_positive |= !is_zero && !is_negative;
        any_negative |= !is_zero && is_negative;
        q = r;
        r = corner[i];
    }
    return any_positive != any_negative;
}

}  // namespace espalier::detail
