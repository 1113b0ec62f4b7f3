// Judges the recipe of the ball and the box in cookbook.md by where it puts them: a ball of radius 0.25 and a cube of
// edge 0.6, in turns, in steps of 1/60 s.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <espalier/espalier.hpp>

#include "support/meshes/mesh.hpp"

namespace espalier::tests {

/// A slope of 1 in 4 from x = -6 to 3, and a level floor at z = -1.5 to x = 24, of triangles that lie anyhow.
inline Mesh make_slope() {
    constexpr std::uint32_t along = 120, across = 24;
    Mesh mesh;
    for (std::uint32_t i = 0; i <= along; ++i) {
        for (std::uint32_t j = 0; j <= across; ++j) {
            const float x = -6.0f + 0.25f * static_cast<float>(i);
            const float y = -5.0f + 0.25f * static_cast<float>(j) + 0.07f * static_cast<float>(i % 3);
            mesh.positions.push_back({x, y, std::max(-0.25f * (x + 3.0f), -1.5f)});
        }
    }
    for (std::uint32_t i = 0; i < along; ++i) {
        for (std::uint32_t j = 0; j < across; ++j) {
            const std::uint32_t a = i * (across + 1) + j, b = a + across + 1;
            const bool turned = (i + j) % 2 == 0;
            mesh.triangles.push_back({a, b, turned ? a + 1 : b + 1});
            mesh.triangles.push_back({turned ? b : a, b + 1, a + 1});
        }
    }
    return mesh;
}

inline bool claim(bool holds, const char* words, std::size_t step, const Vec3& at) {
    if (!holds) {
        std::printf("not true at step %zu, at %g %g %g: %s\n", step, static_cast<double>(at.x),
                    static_cast<double>(at.y), static_cast<double>(at.z), words);
    }
    return holds;
}

inline float apart(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Checks that both bodies rest at the end: in the last two seconds they move by less than a tenth of a millimetre, and
/// in no step by more than a micrometre, a speed of 0.06 mm/s.
inline bool check_rest(const std::vector<Vec3>& places) {
    constexpr std::size_t steps = 120;
    if (places.size() <= 2 * steps) return claim(false, "the recipe draws both bodies", 0, {});
    for (std::size_t i = places.size() - 2 * steps; i < places.size(); ++i) {
        const bool rests = apart(places[i], places[i - 2]) < 1e-6f;
        if (!claim(rests, "the bodies rest", i / 2, places[i])) return false;
    }
    return claim(apart(places[places.size() - 2 * steps], places[places.size() - 2]) < 1e-4f &&
                     apart(places[places.size() - 2 * steps + 1], places.back()) < 1e-4f,
                 "the bodies do not drift", places.size() / 2, places.back());
}

inline float above_slope(const Vec3& p) { return (p.z + 0.25f * (p.x + 3.0f)) / std::sqrt(1.0f + 0.0625f); }

/// Checks the way of the bodies down a slope and on it.
inline bool check_slope(const std::vector<Vec3>& places) {
    constexpr std::size_t landed = 60;  // steps
    constexpr float radius = 0.25f, half_edge = 0.3f;
    bool holds = true;
    for (std::size_t step = landed; 2 * step + 1 < places.size() && holds; ++step) {
        const Vec3 &ball = places[2 * step], &before = places[2 * step - 2], &earlier = places[2 * step - 4];
        const bool on_slope = ball.x<2.5f, on_floor = ball.x> 3.5f;
        const float height = on_slope ? above_slope(ball) : ball.z + 1.5f;
        holds &=
            claim(on_slope == on_floor || std::fabs(height - radius) < 2e-4f, "the ball does not jump", step, ball);
        holds &= claim(std::fabs(ball.y + 3.0f) < 1e-4f, "the ball rolls straight", step, ball);
        holds &= claim(!on_slope || ball.x - before.x > before.x - earlier.x, "the ball gains speed", step, ball);
        const Vec3& cube = places[2 * step + 1];
        holds &= claim(step < 3 * landed || std::fabs(above_slope(cube) - half_edge) < 1.2e-3f,
                       "the cube lies on the slope and does not sink", step, cube);
        holds &= claim(step < 3 * landed || apart(cube, places.back()) < 1e-4f, "the cube does not slide", step, cube);
    }
    return holds &&
           claim(places[places.size() - 2].x > 6.0f, "the ball comes to the floor", 0, places[places.size() - 2]);
}

}  // namespace espalier::tests
