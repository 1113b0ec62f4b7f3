// Blobs that follow the format to the letter and that no baker would make: one node, chains as deep as allowed, extents
// of zero, full and single leaves, boxes much too large, every optional section with anything in it, every profile.
#pragma once

#include "support/base/random.hpp"
#include "support/format/encoder.hpp"

namespace espalier::tests {

/// Boxes hold what is below them. Triangles have area where there is room for it, but for one blob in eight.
PlainBlob make_weird_blob(Random& random);

}  // namespace espalier::tests
