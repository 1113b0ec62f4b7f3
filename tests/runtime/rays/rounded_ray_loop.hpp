// A rounded ray against every triangle: what the public calls and every instruction set must return.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

using Steps = std::int32_t[3];

/// Requires the loop's bits of a ray in a region that begins so many steps before the blob, from the public calls and
/// on every instruction set. Returns the closest hit.
RayHit require_answers_of_the_loop(const DecodedBlob& decoded, const Blob& blob, const RoundedRay& ray,
                                   const Steps& before = {});

}  // namespace espalier::tests
