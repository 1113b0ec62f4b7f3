// Meshes at the ends of what float32 and the format hold: tiny and huge, far from the world's origin, flat, needles,
// slivers, a small thing in a large one, coordinates that are subnormal or as large as floats are.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <espalier/shapes.hpp>

#include "baking.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

struct ExtremeShape {
    std::string name;
    OpenedBlob opened;
    DecodedBlob decoded;
};

/// A closed surface that has a point inside from where all of it is seen. It may be a part of what was baked.
struct ExtremeSolid {
    ExtremeShape shape;
    std::vector<GridTriangle> surface;
    std::array<double, 3> middle;  ///< such a point, in lattice steps
};

/// Each in every profile.
std::vector<ExtremeSolid> make_extreme_solids();
/// Open, flat or tangled, each in every profile.
std::vector<ExtremeShape> make_extreme_surfaces();

}  // namespace espalier::tests
