// When a moving shape first touches something, counted in ticks: 2^24 of them are the whole way.
#pragma once

#include <cstdint>

#include <runtime/lattice_ray.hpp>
#include <runtime/lattice_triangle.hpp>

namespace espalier::detail {

/// The first tick at which the shape touches, or has touched: 0 when it does so at the start already.
using SweepStep = std::uint32_t;

inline constexpr int tick_bits = 24;
inline constexpr SweepStep whole_way = SweepStep{1} << tick_bits;
inline constexpr SweepStep no_contact = 0xFFFFFFFFu;

/// As a share of the way, exactly.
inline float share_of_way(std::uint32_t ticks) { return static_cast<float>(ticks) * power_of_two(-tick_bits); }
/// The last tick before the first contact; the start when it touches there.
constexpr std::uint32_t tick_before(SweepStep step) { return step == 0 ? 0 : step - 1; }

/// Where a moving shape touches a triangle.
struct SweepContact {
    float u = 0.0f;  ///< weight of corner b
    float v = 0.0f;  ///< weight of corner c
    Vec3 normal;     ///< unit, from the triangle towards the shape
};

}  // namespace espalier::detail
