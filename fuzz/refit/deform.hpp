// Deformable blobs that no baker would make.
#pragma once

#include "support/base/random.hpp"
#include "support/format/encoder.hpp"

namespace espalier::fuzz {

/// Returns whether a blob has all that a deformable one needs.
[[nodiscard]] bool can_deform(const tests::PlainBlob& blob);

/// Makes a blob deformable, without the sections that it excludes. Its vertices have positions of their own, or share
/// those of vertices in the same place.
void deform(tests::PlainBlob& blob, tests::Random& random);

}  // namespace espalier::fuzz
