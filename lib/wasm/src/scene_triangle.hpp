// A structure that C passes as arguments of a visitor.
#pragma once

#include <espalier/c/scene.h>
#include <espalier/c/types.h>

/// A triangle of an instance.
struct espalier_scene_triangle {
    espalier_instance_id instance;
    espalier_triangle_id triangle;
};
