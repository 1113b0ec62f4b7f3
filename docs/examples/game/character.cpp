#include "character.hpp"

#include <algorithm>
#include <cmath>

using espalier::Blob;
using espalier::Contact;
using espalier::SweepHit;
using espalier::Vec3;

namespace {

constexpr float gravity = 9.81f;
constexpr int most_surfaces = 6;

/// Most steps end with room on all sides although only the surfaces that the body has run into were minded, which takes
/// a third of the time. The others are taken again.
enum class Care : bool { quick, careful };

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
float length(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 level_part(Vec3 a) { return {a.x, a.y, 0}; }

/// Whether the character can stand on what it touches: on an edge the most level of the faces there counts, which of
/// these the sweep names is no matter.
bool is_ground(const Blob& level, const Character& character, const SweepHit& hit, float down) {
    if (hit.normal.z >= character.least_slope) return true;
    if (hit.normal.z <= 0.1f) return false;
    espalier::Capsule there = character.body();
    there.from.z -= down;
    there.to.z -= down;
    Contact contacts[16];
    for (const Contact& contact : find_contacts(level, there, character.skin, contacts).in(contacts)) {
        const auto corners = triangle_at(level, contact.triangle);
        if (!corners || length(contact.point - hit.point) > 2 * character.skin) continue;
        const Vec3 face = cross(corners->b - corners->a, corners->c - corners->a);
        if (std::abs(face.z) >= character.least_slope * length(face)) return true;
    }
    return false;
}

/// Moves the body to the skin's distance from all that is nearer. Where surfaces leave no room for the body, it ends
/// too near, and update() takes it back.
void keep_distance(const Blob& level, Character& character) {
    for (int attempt = 0; attempt < most_surfaces; ++attempt) {
        Contact near[8];
        const auto found = find_contacts(level, character.body(), character.skin, near);
        if (found.count == 0 || near[0].distance > 0.9f * character.skin) return;
        Vec3 move = {};
        for (int turn = 0; turn < 16; ++turn)
            for (const Contact& contact : found.in(near)) {
                const float gap = character.skin - contact.distance - dot(contact.normal, move);
                if (gap > 0) move = move + contact.normal * gap;
            }
        character.position = character.position + move;
    }
}

/// Moves the body along a way up to what it meets there: carefully to the skin's distance from all surfaces, or quickly to
/// that from this one alone, unless the way hardly leads toward it.
SweepHit move(const Blob& level, Character& character, Vec3 way, Care care) {
    const SweepHit hit = sweep(level, character.body(), way);
    float t = hit.t;  // 1 for a miss and 0 for a refusal
    const float toward = -dot(way, hit.normal);
    const bool is_quick = care == Care::quick && (!hit || toward > 0.25f * length(way));
    if (is_quick && hit) t = std::max(t - character.skin / toward, 0.0f);
    character.position = character.position + way * t;
    if (!is_quick) keep_distance(level, character);
    return hit;
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

/// Returns the surfaces that the body is near, or those few of them that hold it.
Planes near_surfaces(const Blob& level, const Character& character) {
    Planes planes;
    Contact near[8];
    const auto found = find_contacts(level, character.body(), 2 * character.skin, near).in(near);
    for (const Contact& contact : found.first(reduce_contacts(found))) planes.normal[planes.count++] = contact.normal;
    return planes;
}

/// Moves up to the first contact, then what is left of the way along the surfaces that it has met.
void slide(const Blob& level, Character& character, Vec3 way, Care care, Planes planes = {}) {
    while (planes.count < most_surfaces && dot(way, way) > 0) {
        const SweepHit hit = move(level, character, way, planes.count == 0 ? care : Care::careful);
        if (!hit) return;
        planes.normal[planes.count++] = hit.normal;
        way = planes.clip(way * (1 - hit.t));
    }
}

/// Returns whether there is room on all sides: every sweep can start there.
bool has_room(const Blob& level, const Character& character) {
    espalier::Capsule room = character.body();
    room.radius += 0.25f * character.skin;
    return overlaps(level, room).no();  // a refusal is no room
}

/// Moves down to the ground if there is any within a distance, and not above a height. Returns whether there is.
bool drop_to_ground(const Blob& level, Character& character, float distance, Care care, float highest = INFINITY) {
    Character dropped = character;
    const SweepHit hit = move(level, dropped, Vec3{0, 0, -distance}, care);
    if (!hit || !is_ground(level, character, hit, distance * hit.t) || hit.point.z > highest) return false;
    character = dropped;
    return true;
}

/// Walks along the ground, over a step if it leads farther.
void walk_on_ground(const Blob& level, Character& character, Vec3 way, Care care) {
    const Character before = character;
    slide(level, character, way, care);
    const float wished = length(way), walked = length(level_part(character.position - before.position));
    if (walked > 0.99f * wished) return;
    Character stepping = before;
    static_cast<void>(move(level, stepping, {0, 0, character.step_height}, care));
    slide(level, stepping, way, care);
    const float stepped = length(level_part(stepping.position - before.position));
    // The round end of the body would slide over an edge that is higher than a step.
    const float highest = before.position.z - 0.5f * before.height + before.step_height;
    const float down = stepping.position.z - before.position.z + before.skin;
    if (stepped > walked && drop_to_ground(level, stepping, down, care, highest)) character = stepping;
}

/// Walks or falls for one tick.
void move_on(const Blob& level, Character& character, Vec3 walk, float seconds, Care care) {
    const Character before = character;
    if (character.on_ground) {
        character.fall_speed = 0;
        walk_on_ground(level, character, level_part(walk) * seconds, care);
        character.on_ground = drop_to_ground(level, character, character.step_height, care);
        return;
    }
    character.fall_speed += gravity * seconds;
    slide(level, character, (walk - Vec3{0, 0, character.fall_speed}) * seconds, care);
    // What holds it, also a slope that is too steep to stand on, takes its speed.
    character.fall_speed =
        std::min(character.fall_speed, std::max(0.0f, before.position.z - character.position.z) / seconds);
    character.on_ground = drop_to_ground(level, character, 2 * character.skin, care);
}

}  // namespace

espalier::Capsule Character::body() const {
    const float half = 0.5f * height - radius;
    return {position - Vec3{0, 0, half}, position + Vec3{0, 0, half}, radius};
}

void update(const Blob& level, Character& character, Vec3 walk, float seconds) {
    const Character before = character;
    for (const Care care : {Care::quick, Care::careful}) {
        move_on(level, character, walk, seconds, care);
        if (has_room(level, character)) return;
        character = before;
    }
    // Surfaces that approach each other, as a floor and a ceiling that sinks, leave no room: it slides along both, or
    // stays.
    character.fall_speed = 0;
    const Planes planes = near_surfaces(level, character);
    slide(level, character, planes.clip(level_part(walk) * seconds), Care::careful, planes);
    if (!has_room(level, character)) character.position = before.position;
}
