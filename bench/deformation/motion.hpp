// Motions of a mesh: positions as a function of time, 0 at rest and 1 at their end.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include <espalier/shapes.hpp>
#include <espalier/transform.hpp>

#include "../rays.hpp"

namespace espalier::bench {

enum class Motion {
    bend,      ///< into an arc of 90 degrees
    twist,     ///< one end against the other, by 90 degrees
    wave,      ///< across the two longer axes, with two crests
    fold,      ///< one half onto the other
    collapse,  ///< to a plane; a mesh that is flat already, to a line
    noise,     ///< each position on a line of its own, by up to 2 % of the longest side along each axis
    turn,      ///< rigid: by 60 degrees about the diagonal of the axes
};
/// Those that deform. A turn is measured beside them where rigid motion is compared.
inline constexpr std::array deforming = {Motion::bend, Motion::twist,    Motion::wave,
                                         Motion::fold, Motion::collapse, Motion::noise};
const char* name_of(Motion motion);

/// The axes of a mesh, in the order of the sides of its box: the longest first.
class MovingMesh {
public:
    explicit MovingMesh(Mesh mesh);

    [[nodiscard]] const Mesh& rest() const { return mesh_; }
    [[nodiscard]] std::vector<Vec3> positions(Motion motion, double time) const;
    /// Returns the mesh in a pose.
    [[nodiscard]] Mesh posed(Motion motion, double time) const;
    /// Returns the transform from rest to Motion::turn.
    [[nodiscard]] Transform turned(double time) const;

private:
    /// A position along the axes, from the middle of the box.
    using Along = std::array<double, 3>;
    [[nodiscard]] Along moved(Motion motion, double time, const Along& along, std::size_t index) const;
    [[nodiscard]] Along noise_of(std::size_t index) const;

    Mesh mesh_;
    std::array<std::size_t, 3> axes_{};
    Along middle_{}, side_{};  ///< in the order of axes_
};

/// A mesh at one time of a motion.
struct Pose {
    Motion motion;
    double time;
    std::vector<Vec3> positions;
};

/// Returns the poses of all motions that deform, at `times` times each, in an order in which motions alternate.
std::vector<Pose> poses_of(const MovingMesh& mesh, std::size_t times);
/// Returns the box around the mesh in all poses, and in a turn at its end.
Box range_of(const MovingMesh& mesh, std::span<const Pose> poses);

/// Returns a flat square of side * side squares, two triangles each.
Mesh make_cloth(std::size_t side);

}  // namespace espalier::bench
