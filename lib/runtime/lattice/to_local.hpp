// Lattice points back in the local space of the blob.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>
#include <runtime/base/options.hpp>
#include <runtime/lattice/triangle.hpp>

namespace espalier::detail {

/// origin + steps * 2^step_exponent, rounded twice at most. Subnormal numbers become zero, whether the machine would
/// flush them or not: they are far below any lattice step.
ESPALIER_SHARED_CODE inline Vec3 to_local(const BlobData& blob, float x, float y, float z) {
    const float step = power_of_two(blob.step_exponent);
    const auto coordinate = [&](int axis, float steps) {
        return flush_subnormal(blob.origin[axis] + flush_subnormal(steps * step));
    };
    return {coordinate(0, x), coordinate(1, y), coordinate(2, z)};
}
ESPALIER_SHARED_CODE inline Vec3 to_local(const BlobData& blob, const std::int32_t* point) {
    return to_local(blob, static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]));
}

/// Returns the corners in local space, rounded to float.
ESPALIER_SHARED_CODE inline Triangle corners_of(const BlobData& blob, const LatticeTriangle& triangle) {
    return {to_local(blob, triangle.corner[0]), to_local(blob, triangle.corner[1]), to_local(blob, triangle.corner[2])};
}

}  // namespace espalier::detail
