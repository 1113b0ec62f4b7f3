// A mesh that is measured: its motions, their poses, and the fields that all rows about it have.
#pragma once

#include <string>
#include <vector>

#include "../json_object.hpp"
#include "motion.hpp"
#include "options.hpp"

namespace espalier::bench {

class Subject {
public:
    /// Brings the mesh to a common size.
    Subject(Mesh mesh, const Options& options);

    [[nodiscard]] const MovingMesh& moving() const { return moving_; }
    [[nodiscard]] const Mesh& rest() const { return moving_.rest(); }
    [[nodiscard]] const std::vector<Pose>& poses() const { return poses_; }
    [[nodiscard]] const Box& range() const { return range_; }
    [[nodiscard]] double triangles() const { return static_cast<double>(rest().triangles.size()); }
    [[nodiscard]] const Options& options() const { return options_; }
    /// Returns a row with the fields that all have.
    [[nodiscard]] JsonObject row(const std::string& measures) const;

private:
    const Options& options_;
    MovingMesh moving_;
    std::vector<Pose> poses_;
    Box range_;
};

/// Prints the time of a refit of each system, in the poses of all motions. Throws std::runtime_error if a system's
/// outermost box does not contain its pose.
void measure_refits(const Subject& subject);
/// Prints the time of a refit for leaves of several sizes: what a node and a leaf vertex cost.
void measure_nodes(const Subject& subject);
/// Prints the time of a bake for each effort.
void measure_bakes(const Subject& subject);
/// Prints visits and time of rays in the last pose of each motion: after a refit, and after a bake of that pose.
void measure_rays(const Subject& subject);
/// Prints the areas of boxes in the last pose of each motion: in the tree at rest, and in a tree built for that pose.
void measure_boxes(const Subject& subject);

}  // namespace espalier::bench
