// Closed meshes of which the tests know points inside.
#pragma once

#include <vector>

#include "baking.hpp"
#include "support/base/random.hpp"
#include "support/format/decoder.hpp"

namespace espalier::tests {

struct ClosedShape {
    std::string name;
    OpenedBlob opened;
    DecodedBlob decoded;
    /// A point well inside, in lattice steps.
    GridPoint (*inside)(const DecodedBlob&, Random&);
};

std::vector<ClosedShape> make_closed_shapes();

}  // namespace espalier::tests
