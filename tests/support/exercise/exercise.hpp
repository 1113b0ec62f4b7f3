// Every query on one blob, with tame and with hostile arguments: what "every query is safe" means in a test.
#pragma once

#include <cstdint>

#include <espalier/blob.hpp>

#include "support/base/random.hpp"

namespace espalier::tests {

/// Runs each public function on the blob `rounds` times. Throws std::runtime_error when an answer names a triangle that
/// the blob does not have, holds a NaN or breaks its header's word, and when a query takes more steps than it may. What
/// holds only where boxes hold what is below them (soundness.hpp) is asked of sound blobs alone. Returns a hash of all
/// answers' bits.
std::uint64_t exercise(const Blob& blob, Random& random, unsigned rounds, bool sound = true);

}  // namespace espalier::tests
