// Poses of a mesh: its positions, moved.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <espalier/types.hpp>

#include "mesh.hpp"

namespace espalier::tests {

enum class Motion : std::uint8_t {
    rest,      ///< nothing moves
    bend,      ///< the longest axis becomes an arc
    twist,     ///< sections across the longest axis turn
    wave,      ///< sections across the longest axis move up and down
    fold,      ///< one half of the longest axis comes to lie on the other
    collapse,  ///< all positions come to lie in a plane, many triangles on a line
    noise,     ///< each position moves by itself
    point,     ///< all positions become one
};
inline constexpr std::array every_motion = {Motion::rest, Motion::bend,     Motion::twist, Motion::wave,
                                            Motion::fold, Motion::collapse, Motion::noise, Motion::point};

std::string name_of(Motion motion);

/// Returns the positions of a mesh in a pose. `amount` is 1 for the whole motion, a turn by 90 degrees for one that
/// turns; at 0 nothing moves, but for `point`.
std::vector<Vec3> posed(const Mesh& mesh, Motion motion, double amount = 1.0, std::uint64_t seed = 1);

/// Returns every motion of a mesh but rest, each as a whole.
std::vector<std::vector<Vec3>> every_pose(const Mesh& mesh);

/// Returns the box around some poses.
Box box_around(const std::vector<std::vector<Vec3>>& poses);

}  // namespace espalier::tests
