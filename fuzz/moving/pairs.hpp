// Pairs of a moving scene, with itself and with a baked one, against loops over all instances.
#pragma once

#include "support/base/random.hpp"
#include "trial.hpp"

namespace espalier::fuzz {

/// Collects candidate and colliding pairs with filters, pages and limits that are drawn. Ends the program where they
/// are not those of the loops.
void check_pairs(Trial& trial, tests::Random& random);

}  // namespace espalier::fuzz
