// Places are given and returned in the coordinates of the source. Those of a blob count from its origin.
#pragma once

#include <optional>

#include <espalier/blob.hpp>
#include <espalier/types.hpp>

namespace espalier::python {

/// Where 0 0 0 of a blob lies in its source; none where the two have the same coordinates.
using Origin = std::optional<Vec3d>;

/// Returns the origin of a blob.
inline Origin origin_of(const Blob& blob) {
    const Vec3d origin = blob.source_origin();
    return origin == Vec3d{} ? Origin() : Origin(origin);
}

}  // namespace espalier::python
