// A ray moved into the local space of a transform: the definition of to_local(), in the frame of its caller.
#pragma once

#include <espalier/ray.hpp>
#include <runtime/transforms/rotation.hpp>

namespace espalier::detail {

/// Returns the ray moved into local space, or the ray itself if the transform changes nothing.
ESPALIER_SHARED_OR_PART_OF_CALLER inline Ray local_ray(const Transform& transform, const Ray& ray) {
    Ray local = ray;
    if (is_identity(transform)) return local;
    const PreparedTransform prepared(transform);
    local.origin = prepared.point_to_local(ray.origin);
    local.direction = prepared.direction_to_local(ray.direction);
    return local;
}

}  // namespace espalier::detail
