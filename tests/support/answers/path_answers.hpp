// The same questions to every instruction set that this machine has: all answers must have the same bits.
#pragma once

#include <optional>
#include <string>

#include <espalier/blob.hpp>

#include "support/base/random.hpp"

namespace espalier::tests {

/// Every query that has a variant for each instruction set, once, with arguments that are drawn: the name of the path
/// and of the query that differ from the scalar ones, or nothing. On any blob that opens, though equal answers are
/// promised for sound blobs (soundness.hpp) alone: where boxes do not hold what is below them, most answers are equally
/// wrong. Not compared there are batches, closest triangles and the distance of two blobs, for which it matters how
/// many lanes look and what was left out by then, and rays of small code, which sees boxes in its own way.
std::optional<std::string> path_difference(const Blob& blob, Random& random, bool sound);

}  // namespace espalier::tests
