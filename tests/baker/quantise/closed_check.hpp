// Whether a bake is called closed rightly, and whether `contains` is right there, by winding numbers that share no code
// with the library.
#pragma once

#include <cstdint>
#include <string>

#include "support/base/random.hpp"
#include "support/meshes/mesh.hpp"

namespace espalier::tests {

struct ClosedTally {
    std::uint64_t bakes = 0, closed = 0;
    std::uint64_t edges_not_in_pairs = 0;  ///< closed ones with an edge that no single other one runs against
    std::uint64_t lost = 0;                ///< closed sources whose bakes are not
    std::uint64_t points = 0, inside = 0;
    std::uint64_t other_windings = 0;  ///< inside by a winding number that is neither 1 nor -1
    std::uint64_t on_surface = 0;

    [[nodiscard]] std::string text() const;
};

/// Bakes the mesh and asks `points` times whether a point is inside; some of the points are near the surface, on it,
/// or beside corners and edges. Returns what is wrong, or nothing.
std::string check_closed(const Mesh& mesh, const BakeOptions& options, std::uint64_t points, Random& random,
                         ClosedTally& tally);

}  // namespace espalier::tests
