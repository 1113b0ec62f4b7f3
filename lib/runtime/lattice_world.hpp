// Lattice points back in the world.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/float_bits.hpp>

namespace espalier::detail {

/// origin + steps * 2^step_exponent, rounded twice at most.
inline Vec3 to_world(const BlobData& blob, float x, float y, float z) {
    const float step = power_of_two(blob.step_exponent);
    return {blob.origin[0] + x * step, blob.origin[1] + y * step, blob.origin[2] + z * step};
}
inline Vec3 to_world(const BlobData& blob, const std::int32_t* point) {
    return to_world(blob, static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]));
}

}  // namespace espalier::detail
