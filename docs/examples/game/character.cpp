#include "character.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

using espalier::Blob;
using espalier::Contact;
using espalier::ContactPlane;
using espalier::QueryStatus;
using espalier::SweepHit;
using espalier::Vec3;

namespace {

constexpr float gravity = 9.81f;
constexpr std::size_t most_hits = 5, most_planes = 8;

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
float length(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 level_part(Vec3 a) { return {a.x, a.y, 0}; }

/// Whether the character can stand on what it touches: on an edge the most level of the faces there counts, which of
/// these the sweep names is no matter.
bool is_ground(const Blob& level, const Character& character, const SweepHit& hit) {
    if (hit.normal.z >= character.least_slope) return true;
    if (hit.normal.z <= 0.1f) return false;
    Contact contacts[16];
    for (const Contact& contact : find_contacts(level, character.body(), 2 * character.skin, contacts).in(contacts)) {
        const auto corners = triangle_at(level, contact.triangle);
        if (!corners || length(contact.point - hit.point) > 2 * character.skin) continue;
        const Vec3 face = cross(corners->b - corners->a, corners->c - corners->a);
        if (std::abs(face.z) >= character.least_slope * length(face)) return true;
    }
    return false;
}

/// Moves the body along a way up to what it meets, and three quarters of the skin before that. It is swept with half
/// the skin around it, so that what it passes stays as far away and no later sweep starts in it.
SweepHit advance(const Blob& level, Character& character, Vec3 way) {
    espalier::Capsule body = character.body();
    body.radius += 0.5f * character.skin;
    const SweepHit hit = sweep(level, body, way, {.ignore_leaving = true, .skin = 0.25f * character.skin});
    character.position = character.position + way * hit.t;  // t is 1 for a miss and 0 for a refusal
    return hit;
}

/// Returns whether what stops the body is higher than a step: it also stops the lower half of the body above one. That
/// is made thinner, so that it does not touch what stands beside it.
bool is_wall(const Blob& level, const Character& stopped, Vec3 normal) {
    espalier::Capsule raised = stopped.body();
    const Vec3 there = Vec3{0, 0, stopped.step_height} - level_part(normal) * (4 * stopped.skin);
    raised.from = raised.from + there;
    raised.to = stopped.position + there;
    raised.radius -= 2 * stopped.skin;
    return overlaps(level, raised).yes();
}

/// Moves up to the first contact, then what is left of the way along all that the body has met and is near. Returns
/// whether something that is no wall was in the way.
bool slide(const Blob& level, Character& character, Vec3 way) {
    bool may_step = false;
    std::array<ContactPlane, most_hits + most_planes> planes;
    for (std::size_t hits = 0; hits < most_hits; ++hits) {
        const SweepHit hit = advance(level, character, way);
        if (!hit) break;
        planes[hits] = {hit.normal, character.skin, hit.triangle};  // no nearer than now
        const std::span near = std::span(planes).subspan(hits + 1).first(most_planes);
        const std::size_t count = collect_planes(level, character.body(), 2 * character.skin, near).count;
        const std::span all = std::span(planes).first(hits + 1 + count);
        way = way * (1 - hit.t);
        for (const ContactPlane& plane : all.subspan(hits)) {
            const bool is_in_the_way = dot(plane.normal, way) < 0 && plane.normal.z < character.least_slope;
            if (character.on_ground && !may_step && is_in_the_way) may_step = !is_wall(level, character, plane.normal);
        }
        espalier::Result<Vec3> rest = solve_planes(all, way, character.skin);
        if (rest.status != QueryStatus::ok) {  // no room for the skin on all sides: it only comes no nearer
            for (ContactPlane& plane : all) plane.distance = std::max(plane.distance, character.skin);
            rest = solve_planes(all, way, character.skin);
        }
        way = rest.value;
        if (dot(way, way) == 0) break;
    }
    return may_step;
}

/// Moves down to the ground if there is any within a distance, and not above a height. Returns whether there is.
bool drop_to_ground(const Blob& level, Character& character, float distance, float highest = INFINITY) {
    Character dropped = character;
    const SweepHit hit = advance(level, dropped, {0, 0, -distance});
    if (!hit || !is_ground(level, dropped, hit) || hit.point.z > highest) return false;
    character = dropped;
    return true;
}

/// Walks along the ground, over a step if it leads farther.
void walk_on_ground(const Blob& level, Character& character, Vec3 way) {
    const Character before = character;
    const bool may_step = slide(level, character, way);
    const float walked = length(level_part(character.position - before.position));
    if (!may_step || walked > 0.99f * length(way)) return;
    Character stepping = before;
    static_cast<void>(advance(level, stepping, {0, 0, character.step_height}));
    static_cast<void>(slide(level, stepping, way));
    const float stepped = length(level_part(stepping.position - before.position));
    // The round end of the body would slide over an edge that is higher than a step.
    const float highest = before.position.z - 0.5f * before.height + before.step_height;
    const float down = stepping.position.z - before.position.z + before.skin;
    if (stepped > walked && drop_to_ground(level, stepping, down, highest)) character = stepping;
}

/// Returns whether there is room on all sides: every sweep can start there.
bool has_room(const Blob& level, const Character& character) {
    espalier::Capsule room = character.body();
    room.radius += 0.25f * character.skin;
    return overlaps(level, room).no();  // a refusal is no room
}

}  // namespace

espalier::Capsule Character::body() const {
    const float half = 0.5f * height - radius;
    return {position - Vec3{0, 0, half}, position + Vec3{0, 0, half}, radius};
}

void update(const Blob& level, Character& character, Vec3 walk, float seconds) {
    const Character before = character;
    // Where vertices lie on a coarse grid, a query may be moved by more than a skin of a millimetre.
    character.skin = std::max(before.skin, 4 * rounding_error(level, character.body(), walk * seconds).value);
    if (character.on_ground) {
        character.fall_speed = 0;
        walk_on_ground(level, character, level_part(walk) * seconds);
        character.on_ground = drop_to_ground(level, character, character.step_height);
    } else {
        character.fall_speed += gravity * seconds;
        static_cast<void>(slide(level, character, (walk - Vec3{0, 0, character.fall_speed}) * seconds));
        // What holds it, also a slope that is too steep to stand on, takes its speed.
        character.fall_speed =
            std::min(character.fall_speed, std::max(0.0f, before.position.z - character.position.z) / seconds);
        character.on_ground = drop_to_ground(level, character, 2 * character.skin);
    }
    if (!has_room(level, character)) {  // it falls from where it was, which also leads out of what it is in
        character.position = before.position;
        character.fall_speed = 0;
        character.on_ground = false;
    }
    character.skin = before.skin;
}
