// A small building as games have them: what a firmware image or a level of a game is measured with.
#pragma once

#include <cstdint>

#include "mesh.hpp"

namespace espalier::tests {

/// Open: at least that many triangles and at most 33 more, in metres. Rooms of different sizes and heights in a
/// rectangle of about 40 by 30, joined by corridors with steps; a courtyard with uneven ground; pillars, barrels and
/// crates that stand anyhow. Lines of the plan are not evenly spaced, walls share corners with floors only where plan
/// and heights meet.
Mesh make_level(unsigned least_triangles, std::uint64_t seed);

}  // namespace espalier::tests
