// espalier/c/transform.h: transforms.
#include <runtime/c/abi.hpp>

using namespace espalier::detail;

#define TO_LOCAL(name) \
    ESPALIER_C_FUNCTION(espalier_to_local_##name, (transform, moved), c(to_local(cpp(transform), cpp(moved))))
#define TRANSLATED(name) \
    ESPALIER_C_FUNCTION(espalier_translated_##name, (moved, displacement), c(translated(cpp(moved), cpp(displacement))))
/// Applies a macro to what a transform moves and a displacement too.
#define FOR_EACH_MOVED(apply)                                                                               \
    apply(point) apply(segment) apply(sphere) apply(capsule) apply(triangle) apply(box) apply(oriented_box) \
        apply(cone) apply(ray)

FOR_EACH_MOVED(TO_LOCAL)
TO_LOCAL(plane)
TO_LOCAL(transform)
FOR_EACH_MOVED(TRANSLATED)

espalier_transform espalier_identity(void) { return c(espalier::Transform{}); }

ESPALIER_C_FUNCTION(espalier_direction_to_local, (transform, direction),
                    c(direction_to_local(cpp(transform), cpp(direction))))

ESPALIER_C_FUNCTION(espalier_to_world_point, (transform, point), c(to_world(cpp(transform), cpp(point))))

ESPALIER_C_FUNCTION(espalier_direction_to_world, (transform, direction),
                    c(direction_to_world(cpp(transform), cpp(direction))))

ESPALIER_C_FUNCTION(espalier_normal_to_world, (transform, normal), c(normal_to_world(cpp(transform), cpp(normal))))

ESPALIER_C_FUNCTION(espalier_transform_from_matrix, (rows),
                    c(espalier::transform_from_matrix(*reinterpret_cast<const float (*)[3][4]>(rows))))
