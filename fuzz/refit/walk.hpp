// A walk of poses of a deformable blob, each held to a model.
#pragma once

#include <cstddef>
#include <span>

#include "support/base/random.hpp"

namespace espalier::fuzz {

/// Refits the blob to poses that are drawn. Ends the program where a promise of deformation.hpp is broken. The blob
/// opens and is deformable.
void walk_poses(std::span<const std::byte> bytes, tests::Random& random);

}  // namespace espalier::fuzz
