// Claims about the character of docs/examples/game: random walks never end in a wall, behind one, or stuck in the open.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <espalier/espalier.hpp>

#include <game/character.hpp>
#include "support/base/random.hpp"
#include "support/base/test_scale.hpp"
#include "support/base/vectors.hpp"
#include "support/blobs/baking.hpp"
#include "support/meshes/files.hpp"
#include "support/meshes/level_maker.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::tests::character_test {
namespace {

void add_quad(Mesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : {a, b, c, d}) mesh.positions.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A sheet that stands from (x, y) to (u, v): as thin as walls can be.
void add_wall(Mesh& mesh, float x, float y, float u, float v, float low, float high) {
    add_quad(mesh, {x, y, low}, {u, v, low}, {u, v, high}, {x, y, high});
}

void add_block(Mesh& mesh, Vec3 low, Vec3 high) {
    add_quad(mesh, {low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z}, {low.x, high.y, high.z});
    add_wall(mesh, low.x, low.y, high.x, low.y, low.z, high.z);
    add_wall(mesh, high.x, low.y, high.x, high.y, low.z, high.z);
    add_wall(mesh, high.x, high.y, low.x, high.y, low.z, high.z);
    add_wall(mesh, low.x, high.y, low.x, low.y, low.z, high.z);
}

/// An arena of 24 by 24 metres: stairs, slopes that can be climbed and that cannot, gaps between walls from too narrow
/// to wide enough, sharp corners, thin walls, low ceilings, and crates that stand anyhow.
Mesh make_arena() {
    Mesh mesh;
    mesh.name = "arena";
    add_quad(mesh, {-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0});
    for (const auto& [x, y, u, v] : {std::array{-12.0f, -12.0f, 12.0f, -12.0f},
                                     {12.0f, -12.0f, 12.0f, 12.0f},
                                     {12.0f, 12.0f, -12.0f, 12.0f},
                                     {-12.0f, 12.0f, -12.0f, -12.0f}})
        add_wall(mesh, x, y, u, v, 0, 6);
    for (int step = 0; step < 8; ++step) {
        const float x = 2.0f + 0.3f * static_cast<float>(step), z = 0.2f * static_cast<float>(step + 1);
        add_block(mesh, {x, 2, 0}, {x + 0.3f, 5, z});
    }
    add_block(mesh, {4.4f, 2, 0}, {7, 5, 1.6f});
    add_quad(mesh, {-9, 2, 0}, {-5, 2, 0}, {-5, 6, 1.8f}, {-9, 6, 1.8f});      // 24 degrees
    add_quad(mesh, {-9, -6, 0}, {-5, -6, 0}, {-5, -4, 3.5f}, {-9, -4, 3.5f});  // 60 degrees
    for (int gap = 0; gap < 8; ++gap) {
        const float x = -4.0f + 1.5f * static_cast<float>(gap), width = 0.2f + 0.1f * static_cast<float>(gap);
        add_wall(mesh, x, -9, x + 1.5f - width, -9, 0, 3);
    }
    add_wall(mesh, 6, -2, 9, -1.2f, 0, 3);  // a sharp corner
    add_wall(mesh, 6, -2, 9, -2.8f, 0, 3);
    add_wall(mesh, -2, 8, 2, 8.01f, 0, 3);  // two sheets, one behind the other
    add_wall(mesh, -2, 8.02f, 2, 8, 0, 3);
    add_quad(mesh, {-1, -4, 1.9f}, {3, -4, 1.9f}, {3, -1, 1.6f}, {-1, -1, 1.6f});  // a ceiling that sinks
    Random random(12);
    for (int crate = 0; crate < 24; ++crate) {
        const Vec3 at = {10.0f * random.signed_unit(), 10.0f * random.signed_unit(), 0};
        const float size = 0.2f + 0.6f * random.unit(), angle = 3.0f * random.unit();
        const float c = size * std::cos(angle), s = size * std::sin(angle);
        const Vec3 p[4] = {
            {at.x + c, at.y + s, 0}, {at.x - s, at.y + c, 0}, {at.x - c, at.y - s, 0}, {at.x + s, at.y - c, 0}};
        for (int i = 0; i < 4; ++i) add_wall(mesh, p[i].x, p[i].y, p[(i + 1) % 4].x, p[(i + 1) % 4].y, 0, size);
        add_quad(mesh, {p[0].x, p[0].y, size}, {p[1].x, p[1].y, size}, {p[2].x, p[2].y, size}, {p[3].x, p[3].y, size});
    }
    return mesh;
}

struct Walk {
    std::uint64_t tunnels = 0, overlaps = 0, stuck = 0, on_ground = 0, restarts = 0;
    std::vector<double> microseconds;

    [[nodiscard]] double mean() const {
        return std::accumulate(microseconds.begin(), microseconds.end(), 0.0) /
               static_cast<double>(microseconds.size());
    }
    [[nodiscard]] double at(double share) {
        std::sort(microseconds.begin(), microseconds.end());
        return microseconds[static_cast<std::size_t>(share * static_cast<double>(microseconds.size() - 1))];
    }
};

/// Walks about at random from free places of the level, and starts again where it falls out of it.
Walk walk(const Blob& level, float speed, std::uint64_t ticks, std::uint64_t seed) {
    constexpr float seconds = 1.0f / 60.0f;
    Random random(seed);
    Walk result;
    const Box bounds = level.bounds();
    const auto start = [&] {
        for (;;) {
            Character character;
            character.position = random.in_box(bounds);
            const Ray down = {.origin = character.position, .direction = {0.0f, 0.0f, -1.0f}};
            if (overlaps(level, character.body()).no() && raycast(level, down)) return character;
        }
    };
    Character character = start();
    Vec3 wish;
    for (std::uint64_t tick = 0; tick < ticks; ++tick) {
        if (tick % 40 == 0) {
            const float angle = 6.2831853f * random.unit();
            wish = {speed * std::cos(angle), speed * std::sin(angle), 0.0f};
        }
        const Vec3 before = character.position;
        const Vec3 way = {wish.x * seconds, wish.y * seconds, 0.0f};
        const bool is_free = sweep(level, character.body(), way).status == QueryStatus::not_found;
        const auto began = std::chrono::steady_clock::now();
        update(level, character, wish, seconds);
        const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - began;
        result.microseconds.push_back(took.count());
        const Vec3 moved = difference(character.position, before);
        if (overlaps(level, character.body()).yes()) ++result.overlaps;
        if (dot(moved, moved) > 0.0f && occluded(level, Ray::between(before, character.position)).yes())
            ++result.tunnels;
        if (is_free && dot(moved, way) < 0.001f * dot(way, way)) ++result.stuck;
        result.on_ground += character.on_ground ? 1u : 0u;
        if (character.position.z < bounds.min.z - 5.0f || tick % 4000 == 3999) {
            character = start();
            ++result.restarts;
        }
    }
    return result;
}

void require_sound_walks(const Blob& level, const std::string& name, std::uint64_t asked) {
    const std::uint64_t ticks = std::max<std::uint64_t>(asked, 500);  // a walk begins in the air
    for (const float speed : {4.0f, 40.0f}) {
        CAPTURE(name);
        CAPTURE(speed);
        Walk result = walk(level, speed, ticks, 3);
        CHECK(result.tunnels == 0);
        CHECK(result.overlaps == 0);
        CHECK(result.stuck == 0);
        CHECK(result.on_ground > ticks / 4);
        MESSAGE(name, " at ", speed, " m/s: ", ticks, " steps, ", result.on_ground, " on the ground; ", result.mean(),
                " us a step, half of them ", result.at(0.5), ", 99 %: ", result.at(0.99), ", at most ", result.at(1.0));
    }
}

TEST_CASE("controller: random walks in an arena leave no overlap and no tunnel and are never stuck in the open") {
    const OpenedBlob arena(make_arena());
    require_sound_walks(arena.blob, "arena", scaled(2'000));
}

TEST_CASE("controller: random walks where vertices lie on a coarse grid leave no overlap and are never stuck") {
    const OpenedBlob arena(make_arena(), {.resolution = Resolution::bits(9)});
    require_sound_walks(arena.blob, "arena of 9 bits", scaled(2'000));
}

TEST_CASE("controller: random walks in a building leave no overlap and no tunnel") {
    const OpenedBlob level(make_level(4'000, 5));
    require_sound_walks(level.blob, "building", scaled(1'000));
}

TEST_CASE("controller: random walks in the house of the meshes at hand") {
    bool is_skipped = true;
    for (const auto& file : mesh_files()) {
        const Mesh mesh = read_mesh(file);
        if (mesh.name.find("house") == std::string::npos) continue;
        const OpenedBlob house(mesh);
        require_sound_walks(house.blob, mesh.name, scaled(1'000));
        is_skipped = false;
    }
    if (is_skipped) MESSAGE("SKIPPED: no mesh with the name house in the folder ESPALIER_MESHES");
}

TEST_CASE("controller: a character under a ceiling that sinks slides along floor and ceiling") {
    const OpenedBlob arena(make_arena());
    for (int way = 0; way < 60; ++way) {
        CAPTURE(way);
        Character character;
        character.position = {-0.5f + 0.02f * static_cast<float>(way), -3.7f, 0.93f};
        // Until the ceiling is a skin away, then mostly along it.
        for (int tick = 0; tick < 60; ++tick) update(arena.blob, character, {0.0f, 4.0f, 0.0f}, 1.0f / 60.0f);
        const float before = character.position.x;
        for (int tick = 0; tick < 10; ++tick)
            update(arena.blob, character, {4.0f, 0.01f * static_cast<float>(way), 0.0f}, 1.0f / 60.0f);
        CHECK(character.position.x > before + 0.3f);
        CHECK(overlaps(arena.blob, character.body()).no());
    }
}

TEST_CASE("controller: a walk that no sweep takes leaves the character where it was") {
    const OpenedBlob arena(make_arena());
    for (const float speed : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 3e38f})
        for (const bool on_ground : {false, true}) {
            CAPTURE(speed);
            CAPTURE(on_ground);
            Character character;
            character.position = {0.8f, 3.5f, 1.0f};
            character.on_ground = on_ground;
            update(arena.blob, character, {speed, 0.0f, 0.0f}, 1.0f / 60.0f);
            CHECK(character.position.x == 0.8f);
            CHECK(character.position.y == 3.5f);
            CHECK(overlaps(arena.blob, character.body()).no());
            for (int tick = 0; tick < 60; ++tick) update(arena.blob, character, {-1.0f, 0.0f, 0.0f}, 1.0f / 60.0f);
            CHECK(character.on_ground);
            CHECK(character.position.x < 0.0f);
        }
}

TEST_CASE("controller: a character climbs stairs and stands on the platform") {
    const OpenedBlob arena(make_arena());
    Character character;
    character.position = {0.8f, 3.5f, 1.0f};
    for (int tick = 0; tick < 120; ++tick) update(arena.blob, character, {2.5f, 0.0f, 0.0f}, 1.0f / 60.0f);
    CHECK(character.on_ground);
    CHECK(static_cast<double>(character.position.z) == doctest::Approx(2.5).epsilon(0.01));
    // Down again, without leaving the ground.
    int in_the_air = 0;
    for (int tick = 0; tick < 120; ++tick) {
        update(arena.blob, character, {-2.5f, 0.0f, 0.0f}, 1.0f / 60.0f);
        in_the_air += character.on_ground ? 0 : 1;
    }
    CHECK(in_the_air == 0);
    CHECK(static_cast<double>(character.position.z) == doctest::Approx(0.9).epsilon(0.01));
}

TEST_CASE("controller: a character climbs edges up to the height of its step and no higher") {
    for (const float height : {0.33f, 0.37f, 0.45f, 0.6f})
        for (const float speed : {1.0f, 2.5f, 6.0f}) {
            CAPTURE(height);
            CAPTURE(speed);
            Mesh mesh;
            add_quad(mesh, {-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0});
            add_block(mesh, {1, -3, 0}, {9, 3, height});
            const OpenedBlob level(mesh);
            Character character;
            character.position = {0.0f, 0.0f, 1.0f};
            const int ticks = static_cast<int>(180.0f / speed);
            for (int tick = 0; tick < ticks; ++tick) update(level.blob, character, {speed, 0.0f, 0.0f}, 1.0f / 60.0f);
            const bool is_up = static_cast<double>(character.position.z) > 0.9 + 0.5 * static_cast<double>(height);
            CHECK(is_up == (height < character.step_height));
        }
}

TEST_CASE("controller: a character climbs stairs along a wall that it presses against") {
    Mesh mesh;
    add_quad(mesh, {-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0});
    add_wall(mesh, -12, 1, 12, 1, 0, 9);
    for (int step = 0; step < 4; ++step)
        add_block(mesh, {1.0f + 0.5f * static_cast<float>(step), -3, 0}, {12, 1, 0.32f * static_cast<float>(step + 1)});
    const OpenedBlob level(mesh);
    for (const Vec3 walk : {Vec3{2.0f, 1.0f, 0.0f}, {2.0f, 4.0f, 0.0f}}) {
        CAPTURE(walk.y);
        Character character;
        character.position = {0.0f, 0.0f, 0.91f};
        for (int tick = 0; tick < 240; ++tick) update(level.blob, character, walk, 1.0f / 60.0f);
        CHECK(static_cast<double>(character.position.z) == doctest::Approx(0.9 + 4 * 0.32).epsilon(0.01));
    }
}

TEST_CASE("controller: a character that begins in the floor or on it walks on") {
    Mesh mesh;
    add_quad(mesh, {-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0});
    const OpenedBlob level(mesh);
    for (const float height : {0.9f, 0.89f, 0.9001f}) {
        CAPTURE(height);
        Character character;
        character.position = {0.0f, 0.0f, height};
        character.on_ground = true;
        for (int tick = 0; tick < 60; ++tick) update(level.blob, character, {1.0f, 0.0f, 0.0f}, 1.0f / 60.0f);
        CHECK(character.position.x > 0.8f);
        CHECK(overlaps(level.blob, character.body()).no());
    }
}

TEST_CASE("controller: a character climbs stairs whichever of their triangles come first") {
    for (const bool riser_first : {false, true})
        for (const float speed : {1.0f, 2.5f, 6.0f}) {
            CAPTURE(riser_first);
            CAPTURE(speed);
            Mesh mesh;
            add_quad(mesh, {-12, -12, 0}, {12, -12, 0}, {12, 12, 0}, {-12, 12, 0});
            for (int step = 0; step < 6; ++step) {
                const float x = 1.0f + 0.3f * static_cast<float>(step), z = 0.2f * static_cast<float>(step);
                const float end = step < 5 ? x + 0.3f : 12.0f;
                if (riser_first) add_wall(mesh, x, -3, x, 3, z, z + 0.2f);
                add_quad(mesh, {x, -3, z + 0.2f}, {end, -3, z + 0.2f}, {end, 3, z + 0.2f}, {x, 3, z + 0.2f});
                if (!riser_first) add_wall(mesh, x, -3, x, 3, z, z + 0.2f);
            }
            const OpenedBlob level(mesh);
            Character character;
            character.position = {0.0f, 0.0f, 0.91f};
            for (int tick = 0; tick < static_cast<int>(300.0f / speed); ++tick)
                update(level.blob, character, {speed, 0.0f, 0.0f}, 1.0f / 60.0f);
            CHECK(static_cast<double>(character.position.z) == doctest::Approx(2.1).epsilon(0.01));
        }
}

TEST_CASE("controller: a character that walks into a wedge walks out of it") {
    for (const double degrees : {2.0, 10.0, 20.0, 24.0, 26.0, 30.0})
        for (const float speed : {4.0f, 40.0f})
            for (const float aside : {0.0f, 0.7f}) {
                CAPTURE(degrees);
                CAPTURE(speed);
                const auto slope = static_cast<float>(std::tan(degrees * 3.14159265358979 / 180.0));
                Mesh ceiling, corner;
                for (Mesh* mesh : {&ceiling, &corner})
                    add_quad(*mesh, {-12, -12, 0}, {30, -12, 0}, {30, 12, 0}, {-12, 12, 0});
                add_quad(ceiling, {0, -12, 2.0f}, {20, -12, 2.0f - 20 * slope}, {20, 12, 2.0f - 20 * slope},
                         {0, 12, 2.0f});
                add_wall(corner, 0, 1.0f, 20, 1.0f - 20 * slope, 0, 4);
                add_wall(corner, 0, -1.0f, 20, -1.0f, 0, 4);
                for (const Mesh* mesh : {&ceiling, &corner}) {
                    const OpenedBlob level(*mesh);
                    Character character;
                    character.position = {-2.0f, 0.0f, 0.91f};
                    const auto walk = [&](float x, float y) {
                        for (int tick = 0; tick < 600; ++tick)
                            update(level.blob, character, {x, y, 0.0f}, 1.0f / 60.0f);
                    };
                    walk(speed, aside);
                    const float deep = character.position.x;
                    walk(-speed, 0.0f);
                    CHECK(character.position.x < deep - 1.0f);
                }
            }
}

}  // namespace
}  // namespace espalier::tests::character_test
