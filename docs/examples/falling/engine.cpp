#include "engine.hpp"

namespace falling {

namespace {

constexpr std::int32_t gravity = 10;          // 9.8 m/s^2
constexpr std::int32_t most_velocity = 1600;  // 25 m/s

/// Returns a number without pattern that depends on its argument alone.
std::uint32_t hash(std::uint32_t number) {
    std::uint32_t h = number * 0x9E3779B1u + 0x85EBCA77u;
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return h ^ h >> 15;
}
/// Returns a number from -most to most.
std::int32_t choose(std::int32_t most, std::uint32_t number) {
    return static_cast<std::int32_t>(hash(number) % static_cast<std::uint32_t>(2 * most + 1)) - most;
}

std::int64_t dot(const Vector& a, const Vector& b) {
    return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y + std::int64_t{a.z} * b.z;
}
/// Adds a share of a vector, numerator / denominator.
void add(Vector& to, const Vector& way, std::int64_t numerator, std::int64_t denominator) {
    to.x += static_cast<std::int32_t>(way.x * numerator / denominator);
    to.y += static_cast<std::int32_t>(way.y * numerator / denominator);
    to.z += static_cast<std::int32_t>(way.z * numerator / denominator);
}
void limit(std::int32_t& velocity) {
    if (velocity > most_velocity) velocity = most_velocity;
    if (velocity < -most_velocity) velocity = -most_velocity;
}

}  // namespace

espalier::Transform Body::place() const {
    espalier::Transform place;
    place.rotation = rotation;
    place.translation = {static_cast<float>(position.x) / metre, static_cast<float>(position.y) / metre,
                         static_cast<float>(position.z) / metre};
    return place;
}

Engine::Engine(std::uint32_t count, std::uint32_t meshes, const Vector& middle)
    : bodies_(count), meshes_(meshes), middle_(middle) {
    for (std::uint32_t number = 0; number < count; ++number) {
        drop(number);
        bodies_[number].age = hash(number) % longest_life;  // they are not all replaced at once
    }
}

void Engine::drop(std::uint32_t number) {
    const std::uint32_t seed = 8 * dropped_++;
    Body& body = bodies_[number];
    body.position = {middle_.x + choose(8 * metre, seed), middle_.y + choose(8 * metre, seed + 1),
                     middle_.z + choose(8 * metre, seed + 2)};
    body.velocity = {choose(160, seed + 3), choose(160, seed + 4), 0};
    body.rotation = {static_cast<float>(choose(9, seed + 5)), static_cast<float>(choose(9, seed + 6)),
                     static_cast<float>(choose(9, seed + 7)), 10.0f};  // of any length
    body.mesh = dropped_ % meshes_;
    body.age = 0;
}

void Engine::fall() {
    for (Body& body : bodies_) {
        ++body.age;
        body.velocity.z -= gravity;
        limit(body.velocity.x);
        limit(body.velocity.y);
        limit(body.velocity.z);
        add(body.position, body.velocity, 1, 1);
    }
}

void Engine::bounce(std::uint32_t a, std::uint32_t b) {
    Body &first = bodies_[a], &second = bodies_[b];
    Vector way = first.position;
    add(way, second.position, -1, 1);
    const std::int64_t square = dot(way, way);
    if (square == 0) return;
    // Of equal mass: they exchange three quarters of the velocity with which they approach each other.
    const std::int64_t approach = dot(first.velocity, way) - dot(second.velocity, way);
    if (approach < 0) {
        add(first.velocity, way, -3 * approach, 4 * square);
        add(second.velocity, way, 3 * approach, 4 * square);
    }
    add(first.position, way, 1, 64);
    add(second.position, way, -1, 64);
}

void Engine::bounce(std::uint32_t number, const espalier::Vec3& normal) {
    Body& body = bodies_[number];
    constexpr std::int32_t unit = 1 << 10;
    const Vector up = {static_cast<std::int32_t>(normal.x * unit), static_cast<std::int32_t>(normal.y * unit),
                       static_cast<std::int32_t>(normal.z * unit)};
    const std::int64_t approach = dot(body.velocity, up);
    if (approach < 0) add(body.velocity, up, -5 * approach, 4 * unit * unit);
    add(body.velocity, body.velocity, -1, 32);  // friction
    add(body.position, up, metre / 100, unit);
}

}  // namespace falling
