#include "rain.hpp"

#include <espalier/distance.hpp>
#include <espalier/ray.hpp>

namespace flag {

using namespace espalier;

namespace {

constexpr std::int32_t gravity = 10;  // 9.8 m/s^2
constexpr std::int32_t fastest = 9 * metre / steps_per_second;
constexpr std::int32_t start_height = 15 * metre / 4;
constexpr std::int32_t distance_kept = metre / 24;  // from the cloth: more than it moves in a step
constexpr float pushed_within = 1.0f / 24;

/// Returns a number without pattern that depends on its argument alone.
std::uint32_t hash(std::uint32_t number) {
    std::uint32_t h = number * 0x9E3779B1u + 0x85EBCA77u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return h ^ h >> 15;
}
/// Returns a number from low to high.
std::int32_t choose(std::int32_t low, std::int32_t high, std::uint32_t number) {
    return low + static_cast<std::int32_t>(hash(number) % static_cast<std::uint32_t>(high - low + 1));
}

/// Returns the direction away from the cloth, on the side that a query met.
Vector away(const Vec3& normal, Side side) {
    return in_units(side == Side::back ? Vec3{-normal.x, -normal.y, -normal.z} : normal);
}

/// Turns the velocity into the cloth into one away from it: a half of it, or nothing.
void turn_back(Drop& drop, const Vector& normal, std::int64_t halves) {
    const std::int64_t approach = dot(drop.velocity, normal);
    if (approach < 0) add(drop.velocity, normal, -(2 + halves) * approach, 2 * unit * unit);
    add(drop.velocity, drop.velocity, -1, 8);  // friction
}

/// Moves a drop along its path of this step, or up to the cloth.
bool move_along_path(Drop& drop, const Blob& cloth) {
    Vector end = drop.position;
    add(end, drop.velocity, 1, 1);
    const RayHit hit = raycast(cloth, Ray::between(in_metres(drop.position), in_metres(end)));
    if (!hit) {
        drop.position = end;
        return false;
    }
    const Vector normal = away(hit.normal, hit.side);
    add(drop.position, drop.velocity, static_cast<std::int64_t>(hit.t * metre), metre);
    add(drop.position, normal, distance_kept, unit);
    turn_back(drop, normal, 1);
    return true;
}

/// Pushes a drop off that the cloth has come up to.
bool push_off(Drop& drop, const Blob& cloth) {
    const Vec3 position = in_metres(drop.position);
    const ClosestPoint nearest = closest_point(cloth, position, pushed_within);
    if (!nearest) return false;
    const Vector normal = away(nearest.face_normal, nearest.side);
    drop.position.x = static_cast<std::int32_t>(nearest.point.x * metre);
    drop.position.y = static_cast<std::int32_t>(nearest.point.y * metre);
    drop.position.z = static_cast<std::int32_t>(nearest.point.z * metre);
    add(drop.position, normal, distance_kept, unit);
    turn_back(drop, normal, 0);
    return true;
}

}  // namespace

Rain::Rain(std::uint32_t count) : drops_(count) {
    for (std::uint32_t i = 0; i < count; ++i) {
        start(drops_[i]);
        add(drops_[i].position, drops_[i].velocity, choose(0, 30, i + 1'000'000), 1);  // not all at one height
    }
}

void Rain::start(Drop& drop) {
    const std::uint32_t seed = 8 * started_++;
    drop.position = {choose(-metre / 2, 11 * metre / 4, seed), choose(-9 * metre / 4, 0, seed + 1), start_height};
    drop.velocity = {metre / steps_per_second, 5 * metre / steps_per_second, -8 * metre / steps_per_second};
}

void Rain::fall(const Blob& cloth, Counts& counts) {
    for (Drop& drop : drops_) {
        drop.velocity.z = drop.velocity.z - gravity < -fastest ? -fastest : drop.velocity.z - gravity;
        if (move_along_path(drop, cloth)) ++counts.hits;
        else if (push_off(drop, cloth)) ++counts.pushes;
        if (drop.position.z > 0) continue;
        ++counts.landed;
        start(drop);
    }
}

}  // namespace flag
