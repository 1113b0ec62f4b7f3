// A character that walks, falls and slides along what it meets.
#pragma once

#include <espalier/espalier.hpp>

struct Character {
    espalier::Vec3 position;  // of the middle of a sphere
    float radius = 0.4f;
    float fall_speed = 0;  // metres a second
    bool on_ground = false;
};

/// One tick: `walk` is where the player wants to go, in metres a second.
void update(const espalier::Blob& level, Character& character, espalier::Vec3 walk, float seconds);
