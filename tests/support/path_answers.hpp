// The same questions to every instruction set that this machine has: all answers must have the same bits.
#pragma once

#include <optional>
#include <string>

#include <espalier/blob.hpp>

#include "random.hpp"

namespace espalier::tests {

/// Every query that has a variant for each instruction set, once, with arguments that are drawn: the name of the path
/// and of the query that differ from the scalar ones, or nothing. On any blob that opens: where boxes do not hold what
/// is below them, answers are wrong, but they must be equally wrong. Sound blobs alone (soundness.hpp) are asked for
/// batches, closest triangles and the distance of two blobs: how soon these know that a triangle is near depends on
/// how many lanes look, and on other blobs it matters what was left out by then.
std::optional<std::string> path_difference(const Blob& blob, Random& random, bool sound);

}  // namespace espalier::tests
