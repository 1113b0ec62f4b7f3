#include "character.hpp"

#include <cmath>

using espalier::Blob;
using espalier::Contact;
using espalier::SweepHit;
using espalier::Vec3;

namespace {

constexpr float gravity = 9.81f;
constexpr int most_surfaces = 6;

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
float length(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 level_part(Vec3 a) { return {a.x, a.y, 0}; }

/// Whether the character can stand on what it touches: on the edge of a step the face counts, not the edge.
bool is_ground(const Character& character, const SweepHit& hit) {
    const float face = dot(hit.face_normal, hit.normal) < 0 ? -hit.face_normal.z : hit.face_normal.z;
    return hit.normal.z >= character.least_slope || (hit.normal.z > 0.1f && face >= character.least_slope);
}

/// Moves the body to the skin's distance from what is nearer, the deepest contact first. Where surfaces leave no room
/// for the body, it stays.
void keep_distance(const Blob& level, Character& character) {
    const Vec3 before = character.position;
    for (int attempt = 0; attempt < most_surfaces; ++attempt) {
        Contact nearest;
        const auto found = find_contacts(level, character.body(), character.skin, std::span(&nearest, 1));
        if (found.count == 0 || nearest.distance > 0.9f * character.skin) return;
        character.position = character.position + nearest.normal * (character.skin - nearest.distance);
    }
    if (overlaps(level, character.body()).yes()) character.position = before;
}

/// The surfaces that a way has met.
struct Planes {
    Vec3 normal[most_surfaces];
    int count = 0;

    [[nodiscard]] bool allow(Vec3 way) const {
        for (int i = 0; i < count; ++i)
            if (dot(way, normal[i]) < -1e-4f * length(way)) return false;
        return true;
    }
    /// Returns what is left of a way: along one of the surfaces, along the crease of two, or nothing in a corner.
    [[nodiscard]] Vec3 clip(Vec3 way) const {
        if (allow(way)) return way;
        Vec3 best = {};
        const auto keep = [&](Vec3 rest) {
            if (allow(rest) && dot(rest, rest) > dot(best, best)) best = rest;
        };
        for (int i = 0; i < count; ++i) keep(way - normal[i] * dot(way, normal[i]));
        for (int i = 0; i < count; ++i) {
            for (int j = 0; j < i; ++j) {
                const Vec3 crease = cross(normal[i], normal[j]);
                const float squared = dot(crease, crease);
                if (squared > 1e-6f) keep(crease * (dot(way, crease) / squared));
            }
        }
        return best;
    }
};

/// Moves up to the first contact, then what is left of the way along the surfaces that it has met.
void slide(const Blob& level, Character& character, Vec3 way) {
    Planes planes;
    while (planes.count < most_surfaces && dot(way, way) > 0) {
        const SweepHit hit = sweep(level, character.body(), way);
        character.position = character.position + way * hit.t;  // t is 1 for a miss and 0 for a refusal
        keep_distance(level, character);
        if (!hit) return;
        planes.normal[planes.count++] = hit.normal;
        way = planes.clip(way * (1 - hit.t));
    }
}

/// Moves down to the ground if there is any within a distance. Returns whether there is.
bool drop_to_ground(const Blob& level, Character& character, float distance) {
    const SweepHit hit = sweep(level, character.body(), Vec3{0, 0, -distance});
    if (!hit || !is_ground(character, hit)) return false;
    character.position.z -= distance * hit.t;
    keep_distance(level, character);
    return true;
}

/// Walks along the ground, over a step if it leads farther.
void walk_on_ground(const Blob& level, Character& character, Vec3 way) {
    const Character before = character;
    slide(level, character, way);
    const float wished = length(way), walked = length(level_part(character.position - before.position));
    if (walked > 0.99f * wished) return;
    Character stepping = before;
    const Vec3 up = {0, 0, character.step_height};
    stepping.position = stepping.position + up * sweep(level, stepping.body(), up).t;
    keep_distance(level, stepping);
    slide(level, stepping, way);
    const float stepped = length(level_part(stepping.position - before.position));
    if (stepped > walked && drop_to_ground(level, stepping, stepping.position.z - before.position.z + character.skin))
        character = stepping;
}

}  // namespace

espalier::Capsule Character::body() const {
    const float half = 0.5f * height - radius;
    return {position - Vec3{0, 0, half}, position + Vec3{0, 0, half}, radius};
}

void update(const Blob& level, Character& character, Vec3 walk, float seconds) {
    const Character before = character;
    if (character.on_ground) {
        character.fall_speed = 0;
        walk_on_ground(level, character, level_part(walk) * seconds);
        character.on_ground = drop_to_ground(level, character, character.step_height);
    } else {
        character.fall_speed += gravity * seconds;
        slide(level, character, (walk - Vec3{0, 0, character.fall_speed}) * seconds);
        character.on_ground = drop_to_ground(level, character, 2 * character.skin);
    }
    if (overlaps(level, character.body()).yes()) {
        character = before;
        character.fall_speed = 0;
    }
}
