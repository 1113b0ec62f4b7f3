#include "character.hpp"

using espalier::Vec3;

namespace {

constexpr float skin = 0.01f;         // kept from every surface, so that the next sweep does not start on it
constexpr float ground_reach = 0.1f;  // the character stands on what is so close below it
constexpr float gravity = 9.81f;

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// What is left of a way along a surface.
Vec3 along_surface(Vec3 way, Vec3 normal) { return way + normal * -dot(way, normal); }

/// Moves up to the first contact, then what is left along the surface that it met; four surfaces are a corner.
void move_and_slide(const espalier::Blob& level, Character& character, Vec3 way) {
    for (int surfaces = 0; surfaces < 4; ++surfaces) {
        const espalier::Sphere body = {character.position, character.radius};
        const espalier::SweepHit hit = espalier::sweep(level, body, way);
        character.position = character.position + way * hit.t;  // t is 1 for a miss and 0 for a refusal
        if (!hit) return;
        character.position = character.position + hit.normal * skin;
        way = along_surface(way * (1 - hit.t), hit.normal);
    }
}

}  // namespace

void update(const espalier::Blob& level, Character& character, Vec3 walk, float seconds) {
    const espalier::Ray down = {
        .origin = character.position, .direction = {0, 0, -1}, .t_max = character.radius * 1.5f + ground_reach};
    const espalier::RayHit ground = espalier::raycast(level, down);
    character.on_ground =
        ground && ground.normal.z > 0.7f && ground.t * ground.normal.z < character.radius + ground_reach;
    if (character.on_ground) {
        character.fall_speed = 0;
        move_and_slide(level, character, along_surface(walk, ground.normal) * seconds);
    } else {
        character.fall_speed += gravity * seconds;
        move_and_slide(level, character, (walk + Vec3{0, 0, -character.fall_speed}) * seconds);
    }
}
