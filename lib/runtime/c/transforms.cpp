// espalier/c/transform.h: transforms.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

#define TO_LOCAL(name, Local)                                                                           \
    Local espalier_to_local_##name(const espalier_transform* transform, const espalier_##name* shape) { \
        return c(to_local(cpp(transform), cpp(shape)));                                                 \
    }
#define TRANSLATED(name)                                                                                   \
    espalier_##name espalier_translated_##name(const espalier_##name* shape, espalier_vec3 displacement) { \
        return c(translated(cpp(shape), cpp(displacement)));                                               \
    }

espalier_transform espalier_identity(void) { return c(espalier::Transform{}); }

espalier_vec3 espalier_to_local_point(const espalier_transform* transform, espalier_vec3 point) {
    return c(to_local(cpp(transform), cpp(point)));
}

TO_LOCAL(segment, espalier_segment)
TO_LOCAL(sphere, espalier_sphere)
TO_LOCAL(capsule, espalier_capsule)
TO_LOCAL(triangle, espalier_triangle)
TO_LOCAL(box, espalier_oriented_box)
TO_LOCAL(oriented_box, espalier_oriented_box)
TO_LOCAL(cone, espalier_cone)
TO_LOCAL(plane, espalier_plane)
TO_LOCAL(ray, espalier_ray)
TO_LOCAL(transform, espalier_transform)

espalier_vec3 espalier_direction_to_local(const espalier_transform* transform, espalier_vec3 direction) {
    return c(direction_to_local(cpp(transform), cpp(direction)));
}

espalier_vec3 espalier_to_world_point(const espalier_transform* transform, espalier_vec3 point) {
    return c(to_world(cpp(transform), cpp(point)));
}

espalier_vec3 espalier_direction_to_world(const espalier_transform* transform, espalier_vec3 direction) {
    return c(direction_to_world(cpp(transform), cpp(direction)));
}

espalier_vec3 espalier_normal_to_world(const espalier_transform* transform, espalier_vec3 normal) {
    return c(normal_to_world(cpp(transform), cpp(normal)));
}

espalier_vec3 espalier_translated_point(espalier_vec3 point, espalier_vec3 displacement) {
    return c(translated(cpp(point), cpp(displacement)));
}

TRANSLATED(segment)
TRANSLATED(sphere)
TRANSLATED(capsule)
TRANSLATED(triangle)
TRANSLATED(box)
TRANSLATED(oriented_box)
TRANSLATED(cone)
TRANSLATED(ray)

espalier_transform_result espalier_transform_from_matrix(const float rows[12]) {
    return c(espalier::transform_from_matrix(*reinterpret_cast<const float(*)[3][4]>(rows)));
}
