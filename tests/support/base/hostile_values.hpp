// Floats that break careless code.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include <espalier/ray.hpp>

namespace espalier::tests {

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

inline constexpr std::array<float, 38> hostile_values = {
    0.0f,
    -0.0f,
    1.0f,
    -1.0f,
    0.5f,
    std::bit_cast<float>(0x3F7FFFFFu),  // just below 1
    std::bit_cast<float>(0x3F800001u),  // just above 1
    std::numeric_limits<float>::denorm_min(),
    -std::numeric_limits<float>::denorm_min(),
    std::bit_cast<float>(0x007FFFFFu),  // the largest denormal
    std::numeric_limits<float>::min(),
    -std::numeric_limits<float>::min(),
    std::numeric_limits<float>::max(),
    std::numeric_limits<float>::lowest(),
    std::numeric_limits<float>::infinity(),
    -std::numeric_limits<float>::infinity(),
    std::bit_cast<float>(0x7FC00000u),  // quiet NaN
    std::bit_cast<float>(0xFFC00000u),
    std::bit_cast<float>(0x7F800001u),  // signalling NaN
    std::bit_cast<float>(0xFFFFFFFFu),
    0x1p22f,
    0x1p23f,
    -0x1p23f,
    8388609.0f,
    0x1p24f,
    0x1p30f,
    0x1p31f,
    -0x1p31f,
    0x1p32f,
    0x1p62f,
    0x1p63f,
    -0x1p63f,
    0x1p64f,
    0x1p100f,
    0x1p-100f,
    0x1p-126f,
    1e30f,
    -1e-30f,
};

/// The numbers of a ray, those of its window last.
inline std::array<float*, 8> numbers_of(Ray& ray) {
    return {&ray.origin.x,    &ray.origin.y,    &ray.origin.z, &ray.direction.x,
            &ray.direction.y, &ray.direction.z, &ray.t_min,    &ray.t_max};
}

}  // namespace espalier::tests
