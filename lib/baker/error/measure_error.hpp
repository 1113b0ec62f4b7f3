// How far the baked surface is from its source.
#pragma once

#include <cstdint>

#include <baker/quantise/lattice_mesh.hpp>

namespace espalier::baker {

struct MeasuredError {
    float largest = 0.0f;        ///< an upper bound in world units, rounded up; infinite when float32 cannot hold it
    bool is_of_dropped = false;  ///< whether it is the distance of a dropped triangle
    std::uint32_t dropped_triangle = 0;  ///< its original id
};

/// A kept triangle moves no farther than its corners do: each of its points is the same weighted mean of them before
/// and after. A dropped one counts with its distance from what was kept. Where nothing was kept there is no distance;
/// the error is then 0.
[[nodiscard]] MeasuredError measure_error(const Source& source, const LatticeMesh& mesh);

/// Whether every vertex of a triangle with an area is within `tolerance` of its lattice point: a quick test before
/// snapping.
[[nodiscard]] bool vertices_are_within(const Source& source, int step_exponent, double tolerance);

}  // namespace espalier::baker
