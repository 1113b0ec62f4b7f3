// Structures of scenes that the package adds to those of C.
#pragma once

#include <cstdint>

#include <espalier/c/scene.h>
#include <espalier/c/scenes/contacts.h>
#include <espalier/c/scenes/moving_scene.h>
#include <espalier/c/types.h>

#include "flags.hpp"

/// A triangle of an instance.
struct espalier_scene_triangle {
    espalier_instance_id instance;
    espalier_triangle_id triangle;
};

/// An instance near a box.
struct espalier_scene_candidate {
    espalier_instance_id instance;
};

/// What the queries of a batch take into account, and in which order they list it.
struct espalier_scene_selection {
    espalier_flags* only;  ///< by number of an instance, or by slot; null keeps all
    std::uint32_t mask;
    bool sorts;  ///< lists by slot: a moving scene visits in the order of its tree
};

/// An instance of a moving scene and a word for it.
struct espalier_instance_word {
    espalier_instance_handle instance;
    std::uint32_t word;
};
