// The plane of a triangle: its normal, and on which side of it a point lies.
#pragma once

#include <espalier/types.hpp>
#include <runtime/base/options.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/wide_integer.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// Returns the unit normal on the front of the triangle, its coordinates within 4 ulp of 1; zero if it has no area.
ESPALIER_SHARED_CODE inline Vec3 face_normal_of(const LatticeTriangle& triangle) {
    const Integer3 normal = normal_of(integer_triangle(triangle));
    return is_zero(normal) ? Vec3{} : to_unit(normal);
}

/// Returns whether the origin of `triangle` lies behind the triangle's plane. The product of the normal with corner a
/// must fit 128 bits.
ESPALIER_SHARED_CODE inline bool is_origin_behind(const OriginRelative& triangle) {
    return Int128(0) < dot<Int128>(cross(triangle.ab, triangle.ac), triangle.a);
}

}  // namespace espalier::detail
