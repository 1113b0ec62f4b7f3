// falling SCENE.esps: drops some hundred things into a baked scene, z up, and steps them: 400 steps of 1/64 s. Prints
// what touches what, and repeats the last steps from a snapshot.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <span>
#include <vector>

#include <espalier/espalier.hpp>

#include "engine.hpp"
#include "things.hpp"
#include "world.hpp"

namespace {

using namespace falling;

constexpr std::uint32_t body_count = 300;
constexpr int steps_of_line = 50;
constexpr int line_count = 8;

/// What happened since the last line.
struct Counts {
    unsigned pairs = 0, touches = 0, rays = 0, on_bodies = 0, on_town = 0, replaced = 0;
};

void insert(World& world, Engine& engine, std::uint32_t number) {
    Body& body = engine.bodies()[number];
    body.instance = world.insert(body.mesh, body.place(), number);
}

/// Looks down from each body. Replaces those that are old or have left the ground.
void look_down(World& world, Engine& engine, Counts& counts) {
    for (std::uint32_t number = 0; number < engine.bodies().size(); ++number) {
        const Body& body = engine.bodies()[number];
        const Below below = world.look_down(body.instance);
        ++counts.rays;
        counts.on_bodies += below == Below::body ? 1u : 0u;
        counts.on_town += below == Below::town ? 1u : 0u;
        if (below != Below::nothing && body.age <= longest_life) continue;
        ++counts.replaced;
        world.remove(body.instance);
        engine.drop(number);
        insert(world, engine, number);
    }
}

void step(World& world, Engine& engine, std::vector<espalier::Movement>& movements, Counts& counts) {
    engine.fall();
    movements.clear();
    for (const Body& body : engine.bodies()) movements.push_back({body.instance, body.place()});
    world.move(movements);
    for (const espalier::InstancePair& pair : world.find_pairs()) {
        engine.bounce(world.user_of(pair.a), world.user_of(pair.b));
        ++counts.pairs;
    }
    for (const Touch& touch : world.find_touches()) {
        engine.bounce(touch.body, touch.normal);
        ++counts.touches;
    }
    look_down(world, engine, counts);
}

/// Makes the steps of a line and prints it.
void run_line(World& world, Engine& engine, int line) {
    Counts counts;
    std::vector<espalier::Movement> movements;
    for (int i = 0; i < steps_of_line; ++i) step(world, engine, movements, counts);
    const Changes changes = world.take_changes();
    std::printf(
        "step %3d pairs begun %u, ended %u, colliding %u, with the town %u; rays %u: %u to things, %u to the town;"
        " replaced %u\n",
        (line + 1) * steps_of_line, changes.begun, changes.ended, counts.pairs, counts.touches, counts.rays,
        counts.on_bodies, counts.on_town, counts.replaced);
}

/// Returns a place 20 m above what is in the middle of the town.
Vector middle_of(const espalier::BakedScene& town) {
    const espalier::Box bounds = town.bounds();
    const auto between = [](float low, float high) { return static_cast<std::int32_t>(low + (high - low) / 2); };
    const std::int32_t x = between(bounds.min.x, bounds.max.x), y = between(bounds.min.y, bounds.max.y);
    const espalier::Vec3 top = {static_cast<float>(x), static_cast<float>(y), bounds.max.z};
    const auto ground = raycast(town, espalier::Ray{.origin = top, .direction = {0.0f, 0.0f, -1.0f}});
    const float height = ground ? top.z - ground->t : top.z;
    return {x * metre, y * metre, (static_cast<std::int32_t>(height) + 20) * metre};
}

void run(const espalier::BakedScene& town) {
    const Things things;
    World world(things.meshes(), town, body_count);
    Engine engine(body_count, static_cast<std::uint32_t>(things.meshes().size()), middle_of(town));
    for (std::uint32_t number = 0; number < body_count; ++number) insert(world, engine, number);
    std::printf("falling  %u things of %zu meshes into a scene of %u instances, %zu bytes\n", body_count,
                things.meshes().size(), town.instance_count(), world.bytes().size());
    for (int line = 0; line + 1 < line_count; ++line) run_line(world, engine, line);

    // A rollback: the bytes of the world, and a copy of the engine.
    const Snapshot snapshot = world.snapshot();
    const Engine engine_then = engine;
    run_line(world, engine, line_count - 1);
    const std::vector<std::byte> bytes(world.bytes().begin(), world.bytes().end());
    world.restore(snapshot);
    engine = engine_then;
    run_line(world, engine, line_count - 1);
    std::printf("rollback %s\n", std::equal(bytes.begin(), bytes.end(), world.bytes().begin(), world.bytes().end())
                                     ? "the same bytes"
                                     : "other bytes");
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        std::fputs("usage: falling SCENE.esps\n", stderr);
        return 1;
    }
    std::ifstream file(arguments[1], std::ios::binary);
    const std::vector<char> characters{std::istreambuf_iterator<char>(file), {}};
    const std::span<const std::byte> bytes = std::as_bytes(std::span(characters));
    std::vector<espalier::Blob> meshes(espalier::mesh_count_of_scene(bytes));
    std::vector<espalier::BakedScene> tiles(espalier::tile_count_of_scene(bytes));
    const espalier::BakedScene town = open_scene(bytes, meshes, tiles);
    if (!town) {
        std::fprintf(stderr, "falling: %s: %s\n", arguments[1], describe(town.status()));
        return 2;
    }
    try {
        run(town);
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "falling: %s\n", problem.what());
        return 3;
    }
    return 0;
}
