// Places of moving instances, drawn at random.
#pragma once

#include <cmath>

#include <espalier/transform.hpp>

#include "support/base/random.hpp"

namespace espalier::tests {

/// Returns a place with any rotation, a scale from 1/64 to 16, and a translation of up to 2^14.
inline Transform random_place(Random& random) {
    Transform place;
    place.rotation = {random.signed_unit(), random.signed_unit(), random.signed_unit(), random.signed_unit()};
    place.translation = random.in_cube(std::ldexp(1.0f, random.between(-4, 14)));
    place.scale = std::ldexp(1.0f + random.unit(), random.between(-6, 3));
    return place;
}

}  // namespace espalier::tests
