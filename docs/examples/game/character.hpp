// A character that walks, falls, slides along what it meets, climbs steps and stays on the ground.
#pragma once

#include <espalier/espalier.hpp>

/// A capsule that stands upright, z up. Lengths in metres.
struct Character {
    espalier::Vec3 position;  ///< of the middle of the capsule
    float radius = 0.3f;
    float height = 1.8f;        ///< from the lowest point to the highest
    float step_height = 0.35f;  ///< of the highest edge that it climbs; at least what its round end does
    float least_slope = 0.7f;   ///< of the normal of ground, along z: it slides down what is steeper
    float skin = 0.001f;        ///< kept from every surface, so that no sweep starts on it; update() takes 4 times the
                                ///< rounding_error() of the level if that is more
    float fall_speed = 0;       ///< metres a second
    bool on_ground = false;

    [[nodiscard]] espalier::Capsule body() const;
};

/// Moves the character by one tick: `walk` is where the player wants to go, in metres a second. The character never
/// ends in a wall: where no place is free, it stays where it was.
void update(const espalier::Blob& level, Character& character, espalier::Vec3 walk, float seconds);
