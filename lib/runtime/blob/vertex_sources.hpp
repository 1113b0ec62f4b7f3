// The section of vertex sources of a deformable blob.
#pragma once

#include <cstddef>

#include <espalier/blob.hpp>

namespace espalier::detail {

/// Returns where the section begins: behind the corners and their guard.
inline const std::byte* vertex_sources_of(const BlobData& blob) {
    return blob.corners + format::corners::padded_bytes(blob.triangle_count) + format::corners::guard_bytes;
}

}  // namespace espalier::detail
