// Places of moving instances, drawn at random.
#pragma once

#include "support/testing.hpp"

namespace espalier::tests {

/// Returns a place with any rotation, a scale from 1/64 to 16, and a translation of up to 2^14.
inline Transform random_place(Random& random) {
    return {{random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()},
            random.in_cube(std::ldexp(1.0f, random.between(-4, 14))),
            std::ldexp(1.0f + random.unit(), random.between(-6, 3))};
}

}  // namespace espalier::tests
