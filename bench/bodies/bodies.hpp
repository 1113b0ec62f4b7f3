// What a game asks of a level in every frame: small bodies, as Espalier and its peers take them.
#pragma once

#include "../base.hpp"
#include "../peers/contest.hpp"

namespace espalier::bench {

/// A body in the shapes that it may have, all about as wide.
struct Shapes {
    Sphere sphere;
    Capsule capsule;  ///< upright, twice as high as wide
    OrientedBox box;  ///< its half axes are perpendicular
    Box bounds;       ///< axis-aligned, as wide
};

/// A body near the surface, and where it moves.
struct Body {
    Shapes near;    ///< most of them touch it
    float margin;   ///< of contacts
    Shapes before;  ///< a width farther away
    Vec3 way;       ///< from there, as long as three widths, not away from the surface
};

/// The questions, in the order of the columns.
enum class Asked : unsigned {
    overlaps_sphere,
    overlaps_capsule,
    overlaps_box,
    triangles_in_box,
    planes,
    contacts_sphere,
    contacts_capsule,
    contacts_box,
    sweep_sphere,
    sweep_capsule,
    sweep_box,
    count,
};

/// How a system answers one of the questions: yes or no, how many it found, or the share of the way that is free.
using AnswerBody = std::function<float(const Body& body)>;

/// A system over its own copy of a mesh; a question that it does not take has no function.
struct BodySystem {
    std::string name, profile;
    std::array<AnswerBody, static_cast<std::size_t>(Asked::count)> answers;

    AnswerBody& operator[](Asked asked) { return answers[static_cast<std::size_t>(asked)]; }
};

/// The mesh outlives it.
BodySystem box3d_bodies(const Mesh& mesh);

/// The most that contacts and planes are asked for, by all systems.
inline constexpr std::size_t most_contacts = 64;

}  // namespace espalier::bench
