// Points and lengths to ask with: some near the asset, some that break careless code.
#pragma once

#include <bit>

#include <espalier/blob.hpp>

#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"

namespace espalier::tests {

/// A point near the asset more often than not, so that queries reach the leaves.
inline Vec3 some_point(const Blob& blob, Random& random) {
    const Vec3 low = blob.bounds().min;
    const Vec3 high = blob.bounds().max;
    const auto coordinate = [&](float from, float to) {
        const auto kind = random.below(8);
        if (kind == 0) return hostile_values[random.below(hostile_values.size())];
        if (kind == 1) return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        if (kind == 2) return from;
        if (kind == 3) return to;
        return from + (to - from) * (random.unit() * 1.5f - 0.25f);
    };
    const float x = coordinate(low.x, high.x);
    const float y = coordinate(low.y, high.y);
    const float z = coordinate(low.z, high.z);
    return {x, y, z};
}

/// Of the asset's own size, or anything.
inline float some_length(const Blob& blob, Random& random) {
    if (random.below(3) == 0) return hostile_values[random.below(hostile_values.size())];
    return (blob.bounds().max.x - blob.bounds().min.x) * random.unit();
}

}  // namespace espalier::tests
