// Assets as the header of a blob would describe them, and rays at every border that their rounding knows.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <espalier/blob.hpp>
#include <espalier/ray.hpp>

#include "support/base/hostile_values.hpp"
#include "support/base/random.hpp"

namespace espalier::tests {

/// Some number of at most this size. In two steps: the order in which arguments draw is each compiler's own.
inline float some_number(Random& random, std::int32_t least_exponent, std::int32_t most_exponent) {
    const float number = random.signed_unit();
    return std::ldexp(number, random.between(least_exponent, most_exponent));
}

inline float some_hostile(Random& random) {
    return hostile_values[random.below(static_cast<std::uint32_t>(std::size(hostile_values)))];
}

/// An asset somewhere, of some size and some finest step, as the header of a blob would describe it.
inline detail::BlobData some_asset(Random& random) {
    detail::BlobData data;
    data.bits = static_cast<std::uint8_t>(1 + random.below(24));
    data.step_exponent = static_cast<std::int16_t>(random.coin() ? 0 : random.between(-100, 100));
    for (int k = 0; k < 3; ++k) {
        const float steps = some_number(random, 0, 25);
        data.origin[k] = random.below(3) == 0 ? 0.0f : std::ldexp(std::floor(steps), data.step_exponent);
        data.extent[k] = random.below(4) == 0 ? 0 : random.between(0, (1 << data.bits) - 1);
    }
    data.derive();
    return data;
}

/// Somewhere in or about the asset, exactly on a border of it or at one of what the rounding tells apart, any number at
/// all, or one that is hostile.
inline float some_coordinate(const detail::BlobData& data, std::size_t axis, Random& random) {
    const auto steps = [&](float count) { return data.origin[axis] + std::ldexp(count, data.step_exponent); };
    const auto extent = static_cast<float>(data.extent[axis]);
    switch (random.below(8)) {
        case 0:
            return steps(0.0f);
        case 1:
            return steps(extent);
        case 2:
            return steps(random.unit() * extent);
        case 3:  // between the finest steps of rounding
            return steps(static_cast<float>(random.between(-200, 200)) * 0x1p-7f);
        case 4: {  // powers of two and what is beside them
            const float sign = random.coin() ? 1.0f : -1.0f;
            const float power = std::ldexp(sign, random.between(-40, 126));
            return steps(random.coin() ? power : std::nextafter(power, random.coin() ? 0.0f : 2 * power));
        }
        case 5:
            return steps(some_number(random, -30, 122));
        case 6:
            return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
        default:
            return some_hostile(random);
    }
}

inline float some_component(Random& random) {
    const auto kind = random.below(5);
    if (kind == 0) return 0.0f;
    if (kind == 1) return random.coin() ? 1.0f : -1.0f;
    if (kind == 2) return some_number(random, -140, 127);
    if (kind == 3) return static_cast<float>(random.between(-9, 9));
    return std::bit_cast<float>(static_cast<std::uint32_t>(random.next()));
}

inline Vec3 some_place(const detail::BlobData& data, Random& random) {
    const float x = some_coordinate(data, 0, random), y = some_coordinate(data, 1, random);
    return {x, y, some_coordinate(data, 2, random)};
}

/// One that points at the asset from far away, or any.
inline Ray some_ray(const detail::BlobData& data, Random& random) {
    Ray ray = {.origin = some_place(data, random), .direction = {}};
    const float x = some_component(random), y = some_component(random);
    ray.direction = {x, y, some_component(random)};
    if (random.below(3) == 0)
        ray.direction = {data.origin[0] - ray.origin.x, data.origin[1] - ray.origin.y, data.origin[2] - ray.origin.z};
    if (random.below(3) == 0) ray.t_min = std::abs(some_number(random, -140, 60));
    if (random.below(3) == 0) ray.t_max = std::abs(some_number(random, -140, 60));
    if (random.below(16) == 0) ray.t_max = some_hostile(random);
    if (random.below(16) == 0) ray.t_min = random.coin() ? ray.t_max : some_hostile(random);
    return ray;
}

}  // namespace espalier::tests
