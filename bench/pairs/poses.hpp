// Where the second mesh stands, again and again: a fixed seed, so that every system answers the same questions.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <espalier/transform.hpp>

#include "../rays.hpp"

namespace espalier::bench {

/// Rotations are uniform; translations lead in a uniform direction, 0.6 to 1.4 times the length with which 45 to 65 of
/// 100 poses collide, about the middle of the mesh. That length is searched with `collides`.
std::vector<Transform> some_poses(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                  const std::function<bool(const Transform&)>& collides);

/// Row by row.
struct Matrix {
    double at[3][3];
};
Matrix rotation_matrix(const Transform& pose);

}  // namespace espalier::bench
