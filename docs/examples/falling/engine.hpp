// A toy of a physics engine, the part that is not Espalier's: how bodies fall, and how they bounce where it finds them
// to touch. It computes in whole numbers, so that every compiler gives the same motion.
#pragma once

#include <cstdint>
#include <vector>

#include <espalier/espalier.hpp>

namespace falling {

/// Positions in units of 2^-12 m, velocities in units for each step of 1/64 s.
struct Vector {
    std::int32_t x, y, z;
};
constexpr std::int32_t metre = 1 << 12;
/// The number of steps after which a body is replaced.
constexpr std::uint32_t longest_life = 300;

/// A body; its number is its place in Engine::bodies(), and Instance::user of its instance.
struct Body {
    Vector position;
    Vector velocity;
    espalier::Quaternion rotation;
    std::uint32_t mesh;
    std::uint32_t age;  ///< in steps
    espalier::InstanceHandle instance;

    [[nodiscard]] espalier::Transform place() const;
};

class Engine {
public:
    /// Makes bodies of several meshes, around a place in the air.
    Engine(std::uint32_t count, std::uint32_t meshes, const Vector& middle);

    [[nodiscard]] std::vector<Body>& bodies() { return bodies_; }
    /// Puts a body back to where bodies begin.
    void drop(std::uint32_t number);
    /// Moves all bodies by a step.
    void fall();
    /// Two bodies touch: they bounce along the line between their middles.
    void bounce(std::uint32_t a, std::uint32_t b);
    /// A body touches something that stays, whose surface has that normal of unit length.
    void bounce(std::uint32_t number, const espalier::Vec3& normal);

private:
    std::vector<Body> bodies_;
    std::uint32_t meshes_;
    Vector middle_;
    std::uint32_t dropped_ = 0;
};

}  // namespace falling
