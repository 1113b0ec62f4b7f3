// What only deformable blobs have: the box around their pose, and the sources of their vertices.
#pragma once

#include <espalier/blob.hpp>
#include <runtime/base/bits.hpp>

namespace espalier::detail {

/// Tests whether a blob is deformable. Without such blobs in the build, no code is left for them.
inline bool is_deformable(const BlobData& blob) {
    return reads(format::feature::deformable) && blob.corners != nullptr;
}

/// A box in lattice steps; both ends belong to it.
struct PoseBounds {
    std::int32_t low[3];
    std::int32_t high[3];
};

/// Reads the box from the header of a deformable blob, and takes it from the extent of any other.
inline PoseBounds pose_bounds_of(const BlobData& blob) {
    PoseBounds bounds;
    const bool moves = is_deformable(blob);
    for (int k = 0; k < 3; ++k) {
        const std::size_t at = 4 * static_cast<std::size_t>(k);
        bounds.low[k] = moves ? load_i32(blob.bytes + format::header::pose_low_at + at) : 0;
        bounds.high[k] = moves ? load_i32(blob.bytes + format::header::pose_high_at + at) : blob.extent[k];
    }
    return bounds;
}

/// Returns where the section of vertex sources begins: behind the corners and their guard.
inline const std::byte* vertex_sources_of(const BlobData& blob) {
    return blob.corners + format::corners::padded_bytes(blob.triangle_count) + format::corners::guard_bytes;
}

}  // namespace espalier::detail
