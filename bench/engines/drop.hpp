// A simulation of bodies that fall onto a level, in an engine.
#pragma once

#include "../base.hpp"

namespace espalier::tests {
struct Mesh;
}

namespace espalier::bench {

inline constexpr unsigned body_count = 200;
inline constexpr unsigned step_count = 900;
inline constexpr float step_seconds = 1.0f / 60.0f;
inline constexpr double lost_below = -5.0;  ///< bodies there fell through the level, or off its edge

struct Drop {
    std::size_t bytes = 0;  ///< of the mesh: arrays and tree, or the blob
    double ms_per_step = 0.0;
    std::vector<std::array<double, 3>> rest;
    unsigned lost = 0;    ///< bodies below lost_below
    unsigned moving = 0;  ///< other bodies that are faster than 5 cm/s at the end
    double energy = 0.0;  ///< of the other bodies' motion, in joules
};

struct Engine {
    const char* name;
    /// Drops the bodies; onto the engine's own mesh shape if the blob is empty.
    Drop (*drop)(const tests::Mesh& mesh, const Blob& blob);
};

/// Returns the engines that this program was built with.
std::vector<Engine> engines();

/// A body of one kilogram, of the same kind, size and place in all engines.
struct Body {
    enum class Kind { sphere, box, capsule } kind;
    float size;
    Vec3 place;
};
/// Above the ground of the level.
std::vector<Body> make_bodies(const tests::Mesh& mesh);

/// Adds a body as it is at the end.
void add_rest(Drop& drop, const std::array<double, 3>& place, double speed);

}  // namespace espalier::bench
