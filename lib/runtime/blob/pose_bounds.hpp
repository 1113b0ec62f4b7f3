// The box around the triangles of a blob: of a deformable one it changes with the pose, and lies in the header.
#pragma once

#include <cstddef>
#include <cstdint>

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// A box in lattice steps; both ends belong to it.
struct PoseBounds {
    std::int32_t low[3];
    std::int32_t high[3];
};

/// Reads the box from the header of a deformable blob, and takes it from the extent of any other.
inline PoseBounds pose_bounds_of(const BlobData& blob) {
    PoseBounds bounds;
    for (int k = 0; k < 3; ++k) {
        const std::size_t at = 4 * static_cast<std::size_t>(k);
        const bool moves = blob.corners != nullptr;
        bounds.low[k] = moves ? load_i32(blob.bytes + format::header::pose_low_at + at) : 0;
        bounds.high[k] = moves ? load_i32(blob.bytes + format::header::pose_high_at + at) : blob.extent[k];
    }
    return bounds;
}

}  // namespace espalier::detail
